#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace hbvm::core {

/// A scene of a few bodies with masses, lengths and times over many orders. It has rods, chains, loops, surfaces and
/// rigid bodies, and some of all the effects. Its start is consistent in any number of digits. By exact expressions
/// every part moves as a rigid one, or link by link about the one before. The numbers are the same with any compiler:
/// no two are drawn among the arguments of one call, whose order is open.
class RandomScene {
 public:
  explicit RandomScene(std::uint64_t seed) : engine_(seed) {}

  std::string text() {
    d_ = 2 + pick(2);
    const int bodies = 2 + pick(4);
    const std::vector<std::string> sun = place(-3);
    const int mass = pick(9) - 4, time = pick(5) - 2, length = pick(7) - 3;
    std::string out = fmt::format(
        "dimension = {}\n[constants]\nL = \"10^({})\"\nT = \"10^({})\"\nM = \"10^({})\"\n[[point]]\nname = \"o\"\n"
        "position = {}\ncharge = 1\n[[point]]\nname = \"sun\"\nposition = {}\n",
        d_, length, time, mass, list(std::vector<std::string>(size(), "0")), list(sun));
    for (int b = 0; b < bodies; ++b) add_body(b);
    for (const Body& b : bodies_)
      out += fmt::format("[[body]]\nname = \"{}\"\nmass = \"{}*M\"\ncharge = \"{}\"\nposition = {}\nvelocity = {}\n",
                         b.name, b.mass, b.charge, list(b.x), list(b.v));
    if (pick(5) == 0) out += rigid_body();
    return out + constraints_ + effects();
  }

 private:
  struct Body {
    std::string name, mass, charge;
    std::vector<std::string> x, v;  ///< expressions
    bool on_a_rod = false;
  };

  int pick(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }
  std::size_t size() const { return static_cast<std::size_t>(d_); }
  std::string fraction() {
    const int denominator = 20 + pick(7), numerator = pick(41) - 20;
    return fmt::format("({}/{})", numerator, denominator);
  }
  static std::string list(const std::vector<std::string>& x) {
    std::string out;
    for (const std::string& entry : x) out += (out.empty() ? "[\"" : ", \"") + entry + "\"";
    return out + "]";
  }
  /// Near (column, 0, 0) lengths L.
  std::vector<std::string> place(int column) {
    std::vector<std::string> x;
    for (int j = 0; j < d_; ++j) x.push_back(fmt::format("(({}) + {}/2)*L", j == 0 ? column : 0, fraction()));
    return x;
  }
  static std::string difference(const std::string& a, const std::string& b) { return "(" + a + " - " + b + ")"; }
  static std::string dot(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    std::string out;
    for (std::size_t j = 0; j < a.size(); ++j) out += (out.empty() ? "(" : " + ") + a[j] + "*" + b[j];
    return out + ")";
  }
  static std::vector<std::string> between(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    std::vector<std::string> out;
    for (std::size_t j = 0; j < a.size(); ++j) out.push_back(difference(a[j], b[j]));
    return out;
  }
  std::vector<std::string> fractions(int n, const std::string& unit) {
    std::vector<std::string> x;
    for (int i = 0; i < n; ++i) x.push_back(fraction() + unit);
    return x;
  }
  std::vector<std::string> spin() { return fractions(3, "/T"); }
  /// w x r; in the plane w is the third component.
  std::vector<std::string> turned(const std::vector<std::string>& w, const std::vector<std::string>& r) const {
    if (d_ == 2) return {"-(" + w[2] + ")*" + r[1], "(" + w[2] + ")*" + r[0]};
    std::vector<std::string> v;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      v.push_back("((" + w[j] + ")*" + r[k] + " - (" + w[k] + ")*" + r[j] + ")");
    }
    return v;
  }
  void add_rod(const std::string& a, const std::vector<std::string>& at_a, const Body& b) {
    const std::vector<std::string> r = between(b.x, at_a);
    constraints_ += fmt::format("[[constraint]]\nkind = \"rod\"\nbetween = [\"{}\", \"{}\"]\nlength = \"sqrt({})\"\n",
                                a, b.name, dot(r, r));
  }

  void add_body(int number) {
    const int order = pick(7) - 3;
    Body b{fmt::format("b{}", number),
           fmt::format("{}*10^({})", 1 + pick(9), order),
           fmt::format("{}/2", pick(2) == 0 ? 1 + pick(3) : -1 - pick(3)),
           place(number + 1),
           {}};
    const std::vector<std::string> origin(size(), "0");
    const bool from_origin = bodies_.empty() || pick(4) == 0;
    const std::vector<std::string> parent = from_origin ? origin : bodies_.back().x;
    switch (pick(6)) {
      case 0:  // free
        b.v = fractions(d_, "*L/T");
        break;
      case 1: {  // on a surface
        const std::vector<std::string> normal = surface(b);
        b.v = fractions(d_, "*L/T");
        const std::string along = dot(normal, b.v) + "/" + dot(normal, normal);
        for (std::size_t j = 0; j < size(); ++j) b.v[j] = "(" + b.v[j] + " - " + along + "*" + normal[j] + ")";
        break;
      }
      case 2:  // a triangle with the two before, which all turn alike
        if (bodies_.size() >= 2 && !bodies_[bodies_.size() - 2].on_a_rod && !bodies_.back().on_a_rod) {
          Body &one = bodies_[bodies_.size() - 2], &two = bodies_.back();
          if (constraints_.find("\"" + one.name + "\"") == std::string::npos &&
              constraints_.find("\"" + two.name + "\"") == std::string::npos) {
            const std::vector<std::string> w = spin();
            two.v = added(one.v, turned(w, between(two.x, one.x)));
            b.v = added(one.v, turned(w, between(b.x, one.x)));
            add_rod(one.name, one.x, two);
            add_rod(one.name, one.x, b);
            add_rod(two.name, two.x, b);
            one.on_a_rod = two.on_a_rod = b.on_a_rod = true;
            break;
          }
        }
        [[fallthrough]];
      default: {  // a rod to the body before, or to a fixed point
        const std::vector<std::string> w = pick(4) == 0 ? std::vector<std::string>(3, "0") : spin();
        b.v = added(from_origin ? origin : bodies_.back().v, turned(w, between(b.x, parent)));
        add_rod(from_origin ? "o" : bodies_.back().name, parent, b);
        b.on_a_rod = true;
      }
    }
    bodies_.push_back(std::move(b));
  }
  static std::vector<std::string> added(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    std::vector<std::string> out;
    for (std::size_t j = 0; j < a.size(); ++j) out.push_back("(" + a[j] + " + " + b[j] + ")");
    return out;
  }

  /// A plane or a quadric through the body. \return its gradient there
  std::vector<std::string> surface(const Body& b) {
    if (pick(2) == 0) {
      std::vector<std::string> normal;
      for (int j = 0; j < d_; ++j) normal.push_back(fmt::format("(1 + {}/3)", fraction()));
      constraints_ += fmt::format("[[constraint]]\nkind = \"plane\"\nbody = \"{}\"\nnormal = {}\noffset = \"{}\"\n",
                                  b.name, list(normal), dot(normal, b.x));
      return normal;
    }
    // q^T A q + b^T q + c, A diagonally dominant; the numbers of A are pure.
    std::vector<std::vector<std::string>> A(size(), std::vector<std::string>(size()));
    std::vector<std::string> linear, gradient, half;
    std::string rows;
    for (std::size_t i = 0; i < size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j)
        A[i][j] = A[j][i] = i == j ? fmt::format("{}", 1 + pick(3)) : fraction() + "/3";
      linear.push_back(fraction() + "*L");
    }
    for (std::size_t i = 0; i < size(); ++i) {
      rows += (i == 0 ? "" : ", ") + list(A[i]);
      half.push_back(dot(A[i], b.x));
      gradient.push_back("(2*" + half[i] + " + " + linear[i] + ")");
    }
    constraints_ +=
        fmt::format("[[constraint]]\nkind = \"quadric\"\nbody = \"{}\"\nA = [{}]\nb = {}\nc = \"-{} - {}\"\n", b.name,
                    rows, list(linear), dot(half, b.x), dot(linear, b.x));
    return gradient;
  }

  std::string rigid_body() {
    constraints_ +=
        "[[attachment]]\nname = \"tip\"\nof = \"bar\"\nat = " + list(std::vector<std::string>(size(), "L/3")) +
        "\ncharge = 1\n";
    const auto bar = [mass = 1 + pick(3)](const char* fixed_at, const char* center, const std::string& rest) {
      return fmt::format("[[rigid_body]]\nname = \"bar\"\nfixed_at = {}\nmass = \"{}*M\"\ncenter = {}\n{}", fixed_at,
                         mass, center, rest);
    };
    if (d_ == 2)
      return bar("[\"-L\", \"2*L\"]", "[\"L/4\", 0]",
                 "second_moment = [[\"M*L^2\", 0], [0, \"M*L^2/2\"]]\n"
                 "directors = [[\"3/5\", \"4/5\"], [\"-4/5\", \"3/5\"]]\n"
                 "angular_velocity = \"" +
                     fraction() + "/T\"\n");
    return bar(
        "[\"-L\", \"2*L\", 0]", "[\"L/4\", 0, \"L/9\"]",
        "second_moment = [[\"M*L^2\", 0, 0], [0, \"M*L^2/2\", 0], [0, 0, \"2*M*L^2\"]]\n"
        "directors = [[\"4/9\", \"4/9\", \"7/9\"], [\"1/9\", \"-8/9\", \"4/9\"], [\"8/9\", \"-1/9\", \"-4/9\"]]\n"
        "angular_velocity = " +
            list(spin()) + "\n");
  }

  std::string effects() {
    std::string out;
    const auto add = [&](const char* kind, const std::string& keys) {
      out += fmt::format("[[effect]]\nkind = \"{}\"\n{}", kind, keys);
    };
    const std::string pair = fmt::format("between = [[\"{}\", \"{}\"]]\n", bodies_.front().name, bodies_.back().name);
    if (pick(2) == 0) add("uniform_gravity", "acceleration = " + list(fractions(d_, "*L/T^2")) + "\n");
    if (pick(4) == 0)
      add("central_gravity", fmt::format("center = \"sun\"\nstrength = \"{}/4*L^3/T^2\"\n", 1 + pick(6)));
    if (pick(4) == 0) add("mutual_gravity", fmt::format("strength = \"{}/8*L^3/T^2/M\"\n", 1 + pick(3)));
    if (pick(4) == 0) add("coulomb", fmt::format("strength = \"{}/40*M*L^3/T^2\"\n", 1 + pick(6)));
    if (pick(3) == 0) {
      const int rest = pick(3), stiffness = 1 + pick(4);
      add("spring", fmt::format("stiffness = \"{}/4*M/T^2\"\nrest_length = \"{}/2*L\"\n{}", stiffness, rest, pair));
    }
    if (pick(4) == 0) {
      const int exponent = 2 + 2 * pick(2);
      add("trap", fmt::format("center = \"o\"\nstiffness = \"{}/4*M/T^2*L^(2-{})\"\nexponent = {}\n", 1 + pick(4),
                              exponent, exponent));
    }
    if (pick(6) == 0) add("lennard_jones", "depth = \"M*L^2/T^2/100\"\ndiameter = \"L/2\"\n" + pair);
    if (pick(6) == 0) add("radial_cosine", "center = \"o\"\nstrength = \"M*L^2/T^2/(1 + L^2)\"\n");
    if (pick(6) == 0)
      add("oblateness",
          std::string("center = \"sun\"\nstrength = \"L^3/T^2\"\nradius = \"L/2\"\nJ2 = \"1/10\"\naxis = ") +
              (d_ == 2 ? "[\"3/5\", \"4/5\"]\n" : "[\"2/7\", \"3/7\", \"6/7\"]\n"));
    return out;
  }

  std::mt19937_64 engine_;
  int d_ = 2;
  std::vector<Body> bodies_;
  std::string constraints_;
};

}  // namespace hbvm::core

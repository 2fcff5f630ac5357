#include "scenes.hpp"

#include <fmt/format.h>

#include <vector>

namespace hbvm::core {
namespace {

using Texts = std::vector<std::string>;

/// A scene's TOML, a table at a time.
class SceneText {
 public:
  SceneText(const std::string& title, int dimension)
      : text_(fmt::format("title = \"{}\"\ndimension = {}\n", title, dimension)) {}

  SceneText& observe_momenta() {
    text_ += "observables = [\"energy\", \"linear_momentum\", \"angular_momentum\"]\n";
    return *this;
  }
  SceneText& point(const std::string& name, const Texts& position, const std::string& charge = "") {
    text_ += fmt::format("[[point]]\nname = \"{}\"\nposition = {}\n", name, list(position));
    return key("charge", charge);
  }
  SceneText& body(const std::string& name, const std::string& mass, const Texts& position, const Texts& velocity,
                  const std::string& charge = "") {
    text_ += fmt::format("[[body]]\nname = \"{}\"\nmass = \"{}\"\nposition = {}\nvelocity = {}\n", name, mass,
                         list(position), list(velocity));
    return key("charge", charge);
  }
  SceneText& rod(const std::string& a, const std::string& b, const std::string& length) {
    text_ += fmt::format("[[constraint]]\nkind = \"rod\"\nbetween = [\"{}\", \"{}\"]\nlength = \"{}\"\n", a, b, length);
    return *this;
  }
  SceneText& gravity(const Texts& acceleration) {
    text_ += "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = " + list(acceleration) + "\n";
    return *this;
  }
  SceneText& spring(const std::string& a, const std::string& b, const std::string& stiffness,
                    const std::string& rest_length = "") {
    text_ +=
        fmt::format("[[effect]]\nkind = \"spring\"\nbetween = [\"{}\", \"{}\"]\nstiffness = \"{}\"\n", a, b, stiffness);
    return key("rest_length", rest_length);
  }
  SceneText& sun(const std::string& center, const std::string& on) {
    text_ += fmt::format("[[effect]]\nkind = \"central_gravity\"\ncenter = \"{}\"\nstrength = 1\non = [\"{}\"]\n",
                         center, on);
    return *this;
  }
  SceneText& effect(const std::string& kind, const std::string& strength) {
    text_ += fmt::format("[[effect]]\nkind = \"{}\"\nstrength = \"{}\"\n", kind, strength);
    return *this;
  }
  SceneText& lines(const std::string& text) {
    text_ += text;
    return *this;
  }
  Scene read(const std::string& name) const { return read_scene(text_, name); }

 private:
  static std::string list(const Texts& items) {
    std::string result;
    for (const std::string& item : items) result += (result.empty() ? "\"" : ", \"") + item + "\"";
    return "[" + result + "]";
  }
  SceneText& key(const std::string& name, const std::string& value) {
    if (!value.empty()) text_ += fmt::format("{} = \"{}\"\n", name, value);
    return *this;
  }
  std::string text_;
};

std::string times_power(const std::string& x, int exponent) { return fmt::format("({})*2^({})", x, exponent); }

}  // namespace

Scene earth_moon_satellite() {
  return SceneText("Earth, Moon and a satellite, SI units", 2)
      .body("earth", "5.972e24", {"0", "0"}, {"0", "-12.57"})
      .body("moon", "7.342e22", {"3.844e8", "0"}, {"0", "1022"})
      .body("satellite", "1000", {"0", "7e6"}, {"-7546", "-12.57"})
      .effect("mutual_gravity", "6.674e-11")
      .read("earth_moon_satellite");
}

Scene argon_pair() {
  return SceneText("Two argon atoms, SI units", 2)
      .body("a", "6.634e-26", {"0", "0"}, {"0", "20"})
      .body("b", "6.634e-26", {"4e-10", "0"}, {"10", "-20"})
      .lines("[[effect]]\nkind = \"lennard_jones\"\ndepth = \"1.654e-21\"\ndiameter = \"3.405e-10\"\n")
      .read("argon_pair");
}

Scene beside_kepler(const std::string& mass, const std::string& stiffness) {
  SceneText text("A free body beside an orbit", 2);
  text.point("sun", {"0", "0"})
      .body("heavy", "1", {"0", "10"}, {"1", "0"})
      .body("light", mass, {"1/2", "0"}, {"0", "sqrt(3)"})
      .sun("sun", "light");
  if (!stiffness.empty()) text.spring("heavy", "light", stiffness);
  return text.read("beside_kepler");
}

Scene kepler(const std::string& eccentricity, bool at_pericentre) {
  const std::string e = (at_pericentre ? "(" : "(-") + eccentricity + ")";
  return SceneText("Kepler's problem", 2)
      .point("sun", {"0", "0"})
      .body("planet", "1", {"1-" + e, "0"}, {"0", "sqrt((1+" + e + ")/(1-" + e + "))"})
      .sun("sun", "planet")
      .read("kepler");
}

Scene double_pendulum(const std::string& mass_a, const std::string& mass_b, const std::string& length) {
  const std::string l = "(" + length + ")";
  return SceneText("Double pendulum", 2)
      .point("pivot", {"0", "0"})
      .body("a", mass_a, {"4/5", "-3/5"}, {"3/10", "2/5"})
      .body("b", mass_b, {"4/5+5/13*" + l, "-3/5-12/13*" + l}, {"3/10-6/13*" + l, "2/5-5/26*" + l})
      .rod("pivot", "a", "1")
      .rod("a", "b", length)
      .gravity({"0", "-1"})
      .read("double_pendulum");
}

Scene scaled_pendulum(int length, int mass, int time) {
  const auto long_ = [&](const std::string& x) { return times_power(x, length); };
  const auto fast = [&](const std::string& x) { return times_power(x, length - time); };
  return SceneText("Charged double pendulum in units of powers of two", 2)
      .point("pivot", {"0", "0"})
      .point("charge", {long_("3"), long_("1/2")}, "1")
      .body("a", times_power("2", mass), {long_("4/5"), long_("-3/5")}, {fast("3/10"), fast("2/5")}, "1")
      .body("b", times_power("1", mass), {long_("13/10"), long_("-9/5")}, {fast("-3/10"), fast("3/20")}, "1")
      .rod("pivot", "a", long_("1"))
      .rod("a", "b", long_("13/10"))
      .gravity({"0", times_power("-1", length - 2 * time)})
      .effect("coulomb", times_power("1", 3 * length + mass - 2 * time))
      .read("scaled_pendulum");
}

Scene near_upright(const std::string& angle) {
  return SceneText("A pendulum near upright", 2)
      .point("pivot", {"0", "0"})
      .body("bob", "1", {"sin(" + angle + ")", "cos(" + angle + ")"}, {"0", "0"})
      .rod("pivot", "bob", "1")
      .gravity({"0", "-1"})
      .read("near_upright");
}

Scene charge_below(const std::string& distance) {
  return SceneText("A charged pendulum that passes a charge", 2)
      .point("pivot", {"0", "0"})
      .point("charge", {"0", "-(1+" + distance + ")"}, "-1")
      .body("bob", "1", {"4/5", "-3/5"}, {"0", "0"}, "1")
      .rod("pivot", "bob", "1")
      .gravity({"0", "-1"})
      .effect("coulomb", "1")
      .read("charge_below");
}

Scene near_collision(const std::string& velocity) {
  return SceneText("Two bodies that nearly collide", 2)
      .body("a", "1", {"-1", "0"}, {"0", velocity})
      .body("b", "1", {"1", "0"}, {"0", "-(" + velocity + ")"})
      .effect("mutual_gravity", "1")
      .read("near_collision");
}

Scene flat_triangle(const std::string& height) {
  // Turned by (3/5, 4/5); the velocity is that of turning about the origin.
  const auto corner = [&](const std::string& x, const std::string& y) {
    return std::pair<Texts, Texts>({"3/5*(" + x + ")-4/5*(" + y + ")", "4/5*(" + x + ")+3/5*(" + y + ")"},
                                   {"-(4/5*(" + x + ")+3/5*(" + y + "))", "3/5*(" + x + ")-4/5*(" + y + ")"});
  };
  const auto a = corner("-1", "0"), b = corner("3/10", height), c = corner("6/5", "0");
  return SceneText("A rigid triangle, nearly straight", 2)
      .body("a", "1", a.first, a.second)
      .body("b", "1", b.first, b.second)
      .body("c", "1", c.first, c.second)
      .rod("a", "b", "sqrt(1.69+(" + height + ")^2)")
      .rod("b", "c", "sqrt(0.81+(" + height + ")^2)")
      .rod("a", "c", "2.2")
      .gravity({"0", "-1"})
      .read("flat_triangle");
}

Scene stretched_rods(const std::string& height) {
  const std::string r = "(" + height + ")";
  return SceneText("A body held by two rods, nearly collinear", 3)
      .point("left", {"-3/5", "0", "-4/5"})
      .point("right", {"24/25", "0", "32/25"})
      .body("b", "1", {r + "*4/5", "0", "-" + r + "*3/5"}, {"0", r, "0"})
      .rod("left", "b", "sqrt(1+" + r + "^2)")
      .rod("b", "right", "sqrt(2.56+" + r + "^2)")
      .gravity({r + "*4/5", "0", "-" + r + "*3/5"})
      .read("stretched_rods");
}

Scene folding_linkage(const std::string& difference) {
  // b closes the linkage: |b - (2, 0)| = 1 + d and |b - (0, 1)| = 2, to first order at (2, 1). Its exact place, with w
  // = 1 + d, is b = (2 - x, y). There x^2 + y^2 = w^2 and (2 - x)^2 + (y - 1)^2 = 4. So 4 x + 2 y = w^2 + 1 and 5 x^2 -
  // 4 c x + c^2 - w^2 = 0, c = (w^2 + 1)/2.
  const std::string w = "(1+" + difference + ")", c = "((" + w + "^2+1)/2)";
  const std::string x = "((2*" + c + "-sqrt(5*" + w + "^2-" + c + "^2))/5)", y = "(" + c + "-2*" + x + ")";
  // Its velocity (u, v) keeps both: u x = v y and (2 - x) (u - 2) + (y - 1) v = 0.
  const std::string u = "(2*(2-" + x + ")*" + y + "/((2-" + x + ")*" + y + "+(" + y + "-1)*" + x + "))";
  return SceneText("A four-bar linkage that folds", 2)
      .point("left", {"0", "0"})
      .point("right", {"2", "0"})
      .body("a", "1", {"0", "1"}, {"2", "0"})
      .body("b", "2", {"2-" + x, y}, {u, u + "*" + x + "/" + y})
      .rod("left", "a", "1")
      .rod("a", "b", "2")
      .rod("b", "right", w)
      .gravity({"0", "-1"})
      .read("folding_linkage");
}

Scene rods_in_line(const std::string& height) {
  const std::string d = "(" + height + ")";
  return SceneText("Three bodies in a line, three rods", 2)
      .body("a", "1", {"0", "0"}, {"-" + d, "1"})
      .body("b", "1", {"1", d}, {"0", "0"})
      .body("c", "1", {"2", "0"}, {"-" + d, "-1"})
      .rod("a", "b", "sqrt(1+" + d + "^2)")
      .rod("b", "c", "sqrt(1+" + d + "^2)")
      .rod("a", "c", "2")
      .gravity({"0", "-1"})
      .read("rods_in_line");
}

Scene doubled_rod(const std::string& difference) {
  return SceneText("A pendulum held twice", 2)
      .point("pivot", {"0", "0"})
      .body("bob", "1", {"3/5", "-4/5"}, {"2/5", "3/10"})
      .rod("pivot", "bob", "1")
      .rod("pivot", "bob", "1+" + difference)
      .gravity({"0", "-1"})
      .read("doubled_rod");
}

Scene spring_pendulum(const std::string& stiffness) {
  return SceneText("A body on a stiff spring", 2)
      .point("o", {"0", "0"})
      .body("a", "1", {"3/5", "-4/5"}, {"2/5", "3/10"})
      .gravity({"0", "-1"})
      .spring("o", "a", stiffness, "1")
      .read("spring_pendulum");
}

Scene oscillator(const std::string& stiffness) {
  return SceneText("A linear oscillator", 2)
      .point("o", {"0", "0"})
      .body("a", "1", {"3/5", "-4/5"}, {"2/5", "3/10"})
      .gravity({"0", "-1"})
      .spring("o", "a", stiffness)
      .read("oscillator");
}

Scene pendulum_with_spring(const std::string& stiffness) {
  return SceneText("A body on a stiff spring, on a pendulum", 2)
      .point("o", {"0", "0"})
      .body("a", "1", {"0", "-1"}, {"1", "0"})
      .body("b", "1", {"1", "-1"}, {"1", "1/10"})
      .rod("o", "a", "1")
      .spring("a", "b", stiffness, "1")
      .gravity({"0", "-1"})
      .read("pendulum_with_spring");
}

Scene weak_gravity(const std::string& strength) {
  return SceneText("A spring, and a weak force", 2)
      .observe_momenta()
      .body("a", "1", {"0", "0"}, {"1", "0"})
      .body("b", "1", {"1", "0"}, {"0", "1"})
      .spring("a", "b", "1")
      .gravity({"0", "-(" + strength + ")"})
      .read("weak_gravity");
}

Scene whip(int rods) {
  SceneText text("A chain released from horizontal", 2);
  text.point("o", {"0", "0"});
  for (int i = 1; i <= rods; ++i)
    text.body(fmt::format("b{}", i), fmt::format("(9/10)^{}", i), {fmt::format("{}/{}", i, rods), "0"}, {"0", "0"});
  for (int i = 1; i <= rods; ++i)
    text.rod(i == 1 ? "o" : fmt::format("b{}", i - 1), fmt::format("b{}", i), fmt::format("1/{}", rods));
  return text.gravity({"0", "-1"}).read("whip");
}

Scene beads_on_sphere(int beads) {
  SceneText text("Equal charges on the unit sphere", 3);
  text.point("centre", {"0", "0", "0"});
  // A spiral from pole to pole.
  for (int i = 1; i <= beads; ++i) {
    const std::string z = fmt::format("({}/{})", 2 * i - 1 - beads, beads), r = "sqrt(1-" + z + "^2)";
    const std::string turn = fmt::format("({}*pi*(3-sqrt(5)))", i);
    const std::string speed = fmt::format("({}/{})", i % 3 - 1, 8);
    text.body(fmt::format("{}", i), "1", {r + "*cos" + turn, r + "*sin" + turn, z},
              {"-" + speed + "*sin" + turn, speed + "*cos" + turn, "0"}, "1");
  }
  for (int i = 1; i <= beads; ++i) text.rod("centre", fmt::format("{}", i), "1");
  return text.effect("coulomb", "1").read("beads_on_sphere");
}

}  // namespace hbvm::core

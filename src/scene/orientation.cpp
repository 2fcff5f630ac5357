#include "scene/orientation.hpp"

#include <algorithm>
#include <array>

#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

/// A term of an expression, as text.
class Term {
 public:
  Term(const char* text) : text_(text) {}
  Term(const Expression& e) : text_("(" + e.text() + ")") {}

  Term operator+(const Term& b) const { return is("0") ? b : b.is("0") ? *this : joined(" + ", b); }
  Term operator-(const Term& b) const { return b.is("0") ? *this : joined(" - ", b); }
  Term operator*(const Term& b) const {
    if (is("0") || b.is("0")) return "0";
    return is("1") ? b : b.is("1") ? *this : joined("*", b);
  }
  Term operator/(const Term& b) const { return joined("/", b); }
  static Term of(const char* function, const Term& x) { return Term(std::string(function) + x.text_); }

  Expression expression() const { return Expression::parse(text_); }

 private:
  explicit Term(std::string text) : text_(std::move(text)) {}
  bool is(const char* text) const { return text_ == text; }
  Term joined(const char* by, const Term& b) const { return Term("(" + text_ + by + b.text_ + ")"); }

  std::string text_;
};

using Terms = std::array<std::array<Term, 3>, 3>;

SceneMatrix expressions(const Terms& directors) {
  SceneMatrix result;
  for (const auto& director : directors) {
    result.emplace_back();
    for (const Term& entry : director) result.back().push_back(entry.expression());
  }
  return result;
}

/// Row i is R e_i, of the turn about a coordinate axis.
Terms turned_about(char axis, const Term& angle) {
  const Term c = Term::of("cos", angle), s = Term::of("sin", angle), minus_s = Term("0") - s;
  if (axis == 'x') return {{{"1", "0", "0"}, {"0", c, s}, {"0", minus_s, c}}};
  if (axis == 'y') return {{{c, "0", minus_s}, {"0", "1", "0"}, {s, "0", c}}};
  return {{{c, s, "0"}, {minus_s, c, "0"}, {"0", "0", "1"}}};
}

/// The rows of the product R_a R_b, whose transposes a and b hold.
Terms product(const Terms& a, const Terms& b) {
  Terms result = turned_about('z', "0");
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[i][j] = b[i][0] * a[0][j] + b[i][1] * a[1][j] + b[i][2] * a[2][j];
  return result;
}

bool is_sequence(const std::string& letters) {
  return letters.size() == 3 && letters.find_first_not_of("xyz") == std::string::npos && letters[0] != letters[1] &&
         letters[1] != letters[2];
}

bool is_zero(const SceneVector& v, const Constants& constants) {
  return std::all_of(v.begin(), v.end(), [&](const Expression& e) { return evaluate<double>(e, constants) == 0; });
}

}  // namespace

SceneMatrix turned_by_angle(const Expression& angle) {
  const Terms R = turned_about('z', angle);
  return {{R[0][0].expression(), R[0][1].expression()}, {R[1][0].expression(), R[1][1].expression()}};
}

SceneMatrix turned_by_quaternion(const SceneVector& quaternion) {
  const Term w = quaternion[0], x = quaternion[1], y = quaternion[2], z = quaternion[3];
  const Term ww = w * w, xx = x * x, yy = y * y, zz = z * z, n = ww + xx + yy + zz, two = "2";
  return expressions({{{(ww + xx - yy - zz) / n, two * (x * y + w * z) / n, two * (x * z - w * y) / n},
                       {two * (x * y - w * z) / n, (ww - xx + yy - zz) / n, two * (y * z + w * x) / n},
                       {two * (x * z + w * y) / n, two * (y * z - w * x) / n, (ww - xx - yy + zz) / n}}});
}

SceneMatrix turned_about_axis(const SceneVector& axis, const Expression& angle) {
  const Term x = axis[0], y = axis[1], z = axis[2], one = "1";
  const Term nn = x * x + y * y + z * z, c = Term::of("cos", angle), less = (one - c) / nn;
  const Term s = Term::of("sin", angle) / Term::of("sqrt", nn);
  return expressions({{{c + less * x * x, less * x * y + s * z, less * x * z - s * y},
                       {less * x * y - s * z, c + less * y * y, less * y * z + s * x},
                       {less * x * z + s * y, less * y * z - s * x, c + less * z * z}}});
}

SceneMatrix turned_by_euler_angles(const SceneVector& angles, const std::string& sequence) {
  Terms R = turned_about(sequence[0], angles[0]);
  for (std::size_t i = 1; i < 3; ++i) R = product(R, turned_about(sequence[i], angles[i]));
  return expressions(R);
}

SceneMatrix read_orientation(TomlTable& body, std::size_t dimension, const Constants& constants) {
  const toml::node& node = body.require("orientation");
  const toml::table* const table = node.as_table();
  if (!table) {
    if (dimension == 2) return turned_by_angle(body.to_number(node, "'orientation'"));
    body.fail(node,
              "'orientation' must be a table: { quaternion = [w, x, y, z] }, { axis = [...], angle = ... } or "
              "{ euler = [...], sequence = \"zxz\" }");
  }
  TomlTable reader(body.source(), *table, body.what() + ", orientation");
  const auto read = [&]() -> SceneMatrix {
    if (reader.has("directors")) return reader.matrix("directors", dimension);
    if (dimension == 2) return turned_by_angle(reader.number("angle"));
    if (reader.has("quaternion")) {
      constexpr std::size_t entries = 4;
      const SceneVector quaternion = reader.vector("quaternion", entries);
      if (is_zero(quaternion, constants)) reader.fail("'quaternion' must not be 0");
      return turned_by_quaternion(quaternion);
    }
    if (reader.has("axis")) {
      const SceneVector axis = reader.vector("axis", 3);
      if (is_zero(axis, constants)) reader.fail("'axis' must not be 0");
      return turned_about_axis(axis, reader.number("angle"));
    }
    if (!reader.has("euler")) reader.missing({"quaternion", "axis", "euler", "directors"});
    const SceneVector angles = reader.vector("euler", 3);
    const std::string sequence = reader.string("sequence");
    if (!is_sequence(sequence))
      reader.fail(
          "'sequence' must be three axes of which no two in a row are the same, as \"zxz\" or \"zyx\"; each "
          "turn is about an axis of the body as it is turned already");
    return turned_by_euler_angles(angles, sequence);
  };
  SceneMatrix directors = read();
  reader.finish();
  return directors;
}

}  // namespace hbvm::core

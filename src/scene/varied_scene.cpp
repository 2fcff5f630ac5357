#include "scene/varied_scene.hpp"

#include <fmt/format.h>

#include "scalar/literal.hpp"
#include "scene/set_number.hpp"

namespace hbvm::core {

std::vector<Expression> values_between(const Expression& from, const Expression& to, long count) {
  std::vector<Expression> values;
  for (long i = 0; i < count; ++i)
    values.push_back(
        Expression::parse(fmt::format("({0})+(({1})-({0}))*{2}/{3}", from.text(), to.text(), i, count - 1)));
  return values;
}

std::vector<double> VariedScene::near() const {
  std::vector<double> rounded;
  for (const Expression& value : values) rounded.push_back(evaluate<double>(value, scene.constants));
  return rounded;
}

std::vector<VariedScene> varied_scenes(const Scene& scene, const std::vector<VariedNumber>& numbers) {
  std::vector<VariedScene> all{{scene, {}}};
  for (const VariedNumber& number : numbers) {
    std::vector<VariedScene> more;
    for (const VariedScene& one : all)
      for (const Expression& value : number.values) {
        VariedScene& next = more.emplace_back(VariedScene{with_number(one.scene, number.name, value), one.values});
        next.values.push_back(value);
      }
    all = std::move(more);
  }
  return all;
}

}  // namespace hbvm::core

#include "step/formulation.hpp"

#include "hbvm/error.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

constexpr std::string_view projected = "+project", stabilised = "+baumgarte:", ggl = "+ggl";

/// A number that is not negative. \throws InputError
Number rate(std::string_view text, std::string_view of) {
  const auto refuse = [&](const std::string& why) {
    throw InputError("+baumgarte:" + std::string(of) + ": " + why +
                     "; use two numbers that are not negative, as +baumgarte:5,5");
  };
  try {
    const Expression number = Expression::parse(text);
    if (evaluate<double>(number) < 0) refuse("'" + std::string(text) + "' is negative");
    return number.text();
  } catch (const ExpressionError& error) {
    refuse(error.what());
  }
  return "0";
}

}  // namespace

std::string Formulation::suffix() const {
  switch (on_constraints) {
    case OnConstraints::project:
      return std::string(projected);
    case OnConstraints::baumgarte:
      return std::string(stabilised) + alpha.text() + "," + beta.text();
    case OnConstraints::ggl:
      return std::string(ggl);
    case OnConstraints::drift:
      break;
  }
  return {};
}

std::string Formulation::title() const {
  switch (on_constraints) {
    case OnConstraints::project:
      return ", projected";
    case OnConstraints::baumgarte:
      return ", Baumgarte(" + alpha.text() + "," + beta.text() + ")";
    case OnConstraints::ggl:
      return ", GGL";
    case OnConstraints::drift:
      break;
  }
  return {};
}

FormulatedName FormulatedName::parse(std::string_view text) {
  if (text.ends_with(projected))
    return {std::string(text.substr(0, text.size() - projected.size())), OnConstraints::project};
  if (text.ends_with(ggl)) return {std::string(text.substr(0, text.size() - ggl.size())), OnConstraints::ggl};
  const std::size_t at = text.rfind(stabilised);
  if (at == std::string_view::npos) return {std::string(text), {}};
  const std::string_view numbers = text.substr(at + stabilised.size());
  const std::size_t comma = numbers.find(',');
  if (comma == std::string_view::npos)
    throw InputError("+baumgarte:" + std::string(numbers) + ": use two numbers, alpha and beta of g'' + 2 alpha g' + " +
                     "beta^2 g = 0, as +baumgarte:5,5");
  return {std::string(text.substr(0, at)),
          Formulation(OnConstraints::baumgarte, rate(numbers.substr(0, comma), numbers),
                      rate(numbers.substr(comma + 1), numbers))};
}

}  // namespace hbvm::core

#include "hbvm/analysis/step_halving.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hbvm/analysis/simulate.hpp"
#include "hbvm/scalar/text.hpp"
#include "hbvm/scalar/with_scalar.hpp"

namespace hbvm {
namespace {

template <Scalar S>
struct Errors {
  S y, lambda, hid, g, H;
};

template <Scalar S>
std::string rate(const S& above, const S& here, const S& size) {
  using std::log;
  if (here <= 16 * epsilon<S>() * size) return "***";
  return fmt::format("{:.1f}", approximately(S(log(S(above / here)) / log(S(2)))));
}

template <Scalar S>
std::vector<HalvingRow> step_halving_in(const HalvingRequest& request, const std::function<void()>& after_each_run) {
  const Assembled<S> scene = assemble<S>(*request.scene);
  const StepperMaker<S> make_stepper = request.method->prepare(scene.problem, request.solver);
  std::optional<Simulated<S>> coarse;
  std::optional<Errors<S>> above;
  std::vector<HalvingRow> rows;
  for (int i = request.first; i <= request.last + 1; ++i) {
    Constants constants = request.scene->constants;
    constants.insert_or_assign("i", Expression::parse(std::to_string(i)));
    const TimeGrid<S> grid(request.step, request.until, constants);
    const std::unique_ptr<Stepper<S>> stepper = make_stepper();
    Simulated<S> fine = simulate<S>(scene, *stepper, grid);
    after_each_run();
    if (coarse) {
      const Snapshot<S>&a = coarse->integration.end, &b = fine.integration.end;
      const S q_size = max_norm(b.q), p_size = max_norm(b.p);
      const S y_size = std::max(q_size, p_size), lambda_size = max_norm(b.lambda);
      const S H_size = std::max(magnitude(fine.H0), S(p_size * p_size));
      Errors<S> e{std::max(distance(a.q, b.q), distance(a.p, b.p)), distance(a.lambda, b.lambda), fine.e_hid, fine.e_g,
                  fine.e_H};
      HalvingRow row;
      row.i = i - 1;
      row.steps = grid.steps();
      row.e_y = to_scientific(e.y, 3);
      row.e_lambda = to_scientific(e.lambda, 3);
      row.e_hid = to_scientific(e.hid, 3);
      row.e_g = to_scientific(e.g, 3);
      row.e_H = to_scientific(e.H, 3);
      if (above) {
        row.rate_y = rate(above->y, e.y, y_size);
        row.rate_lambda = rate(above->lambda, e.lambda, lambda_size);
        row.rate_hid = rate(above->hid, e.hid, S(q_size * p_size));
        row.rate_H = rate(above->H, e.H, H_size);
      }
      const auto ulps = [](const S& error, const S& size) { return approximately(S(error / (size * epsilon<S>()))); };
      row.ulps_lambda = ulps(e.lambda, lambda_size);
      row.ulps_hid = ulps(e.hid, S(q_size * p_size));
      row.ulps_g = ulps(e.g, S(q_size * q_size));
      row.ulps_H = ulps(e.H, H_size);
      rows.push_back(std::move(row));
      above = std::move(e);
    }
    coarse = std::move(fine);
  }
  return rows;
}

}  // namespace

std::string HalvingRow::cell(const std::string& column) const {
  const auto or_none = [](const std::optional<std::string>& rate) { return rate.value_or("---"); };
  if (column == "i") return std::to_string(i);
  if (column == "e_y") return e_y;
  if (column == "e_lambda") return e_lambda;
  if (column == "e_hid") return e_hid;
  if (column == "e_g") return e_g;
  if (column == "e_H") return e_H;
  if (column == "rate_y") return or_none(rate_y);
  if (column == "rate_lambda") return or_none(rate_lambda);
  if (column == "rate_hid") return or_none(rate_hid);
  if (column == "rate_H") return or_none(rate_H);
  throw InputError("a table of step halvings has no column '" + column + "'");
}

bool HalvingRow::is_round_off(const std::string& column) const {
  const double n = static_cast<double>(1 + steps), walk = std::sqrt(n);
  if (column == "e_lambda") return ulps_lambda <= 32 * n;
  if (column == "e_hid") return ulps_hid <= 16 * walk;
  if (column == "e_g") return ulps_g <= 4 * walk;
  if (column == "e_H") return ulps_H <= 4 * walk;
  throw InputError("column '" + column + "' cannot be round-off");
}

std::vector<HalvingRow> step_halving(const HalvingRequest& request, const Precision& precision,
                                     const std::function<void()>& after_each_run) {
  return with_scalar(precision, [&]<Scalar S>() { return step_halving_in<S>(request, after_each_run); });
}

}  // namespace hbvm

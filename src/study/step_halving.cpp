#include "study/step_halving.hpp"

#include <fmt/format.h>

#include <cmath>

#include "linear/vector_text.hpp"
#include "long_work/json.hpp"
#include "run/simulate.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"
#include "scalar/with_scalar.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
struct Errors {
  S y, lambda, hid, g, H;
};

template <Scalar S>
std::string rate(const S& above, const S& here, const S& size, Digits digits) {
  using std::log;
  if (here <= 16 * epsilon<S>() * size) return "***";
  const double log2 = approximately(S(log(S(above / here)) / log(S(2))));
  return digits == Digits::all ? fmt::format("{}", log2) : fmt::format("{:.1f}", log2);
}

template <Scalar S>
HalvingRun halving_run_in(const HalvingRequest& request, int i) {
  const Assembled<S> scene = assemble<S>(*request.scene);
  Constants constants = request.scene->constants;
  constants.insert_or_assign("i", Expression::parse(std::to_string(i)));
  const TimeGrid<S> grid(request.step, request.until, constants);
  const std::unique_ptr<Stepper<S>> stepper = request.method->make_stepper(scene.problem, request.solver);
  const Simulated<S> run = simulate<S>(scene, *stepper, grid);
  const Snapshot<S>& end = run.integration.end;
  return {grid.steps(),    to_texts(end.q),  to_texts(end.p),  to_texts(end.lambda),
          to_text(run.H0), to_text(run.e_H), to_text(run.e_g), to_text(run.e_hid)};
}

/// A run's numbers in the working precision again.
template <Scalar S>
struct End {
  Vector<S> q, p, lambda;
  S H0, e_H, e_g, e_hid;

  explicit End(const HalvingRun& run)
      : q(vector_of<S>(run.q)),
        p(vector_of<S>(run.p)),
        lambda(vector_of<S>(run.lambda)),
        H0(literal<S>(run.H0)),
        e_H(literal<S>(run.e_H)),
        e_g(literal<S>(run.e_g)),
        e_hid(literal<S>(run.e_hid)) {}
};

template <Scalar S>
std::vector<HalvingRow> halving_rows_in(const HalvingRequest& request, const std::vector<HalvingRun>& runs,
                                        Digits digits) {
  const auto shown = [&](const S& x) { return digits == Digits::all ? to_text(x) : to_scientific(x, 3); };
  std::optional<Errors<S>> above;
  std::vector<HalvingRow> rows;
  for (std::size_t n = 0; n + 1 < runs.size(); ++n) {
    const End<S> a(runs[n]), b(runs[n + 1]);
    const S q_size = max_norm(b.q), p_size = max_norm(b.p);
    const S y_size = std::max(q_size, p_size), lambda_size = max_norm(b.lambda);
    const S H_size = std::max(magnitude(b.H0), S(p_size * p_size));
    Errors<S> e{std::max(distance(a.q, b.q), distance(a.p, b.p)), distance(a.lambda, b.lambda), b.e_hid, b.e_g, b.e_H};
    HalvingRow row;
    row.i = request.first + static_cast<int>(n);
    row.steps = runs[n + 1].steps;
    row.e_y = shown(e.y);
    row.e_lambda = shown(e.lambda);
    row.e_hid = shown(e.hid);
    row.e_g = shown(e.g);
    row.e_H = shown(e.H);
    if (above) {
      row.rate_y = rate(above->y, e.y, y_size, digits);
      row.rate_lambda = rate(above->lambda, e.lambda, lambda_size, digits);
      row.rate_hid = rate(above->hid, e.hid, S(q_size * p_size), digits);
      row.rate_H = rate(above->H, e.H, H_size, digits);
    }
    const auto ulps = [](const S& error, const S& size) { return approximately(S(error / (size * epsilon<S>()))); };
    row.ulps_lambda = ulps(e.lambda, lambda_size);
    row.ulps_hid = ulps(e.hid, S(q_size * p_size));
    row.ulps_g = ulps(e.g, S(q_size * q_size));
    row.ulps_H = ulps(e.H, H_size);
    rows.push_back(std::move(row));
    above = std::move(e);
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

HalvingRun halving_run(const HalvingRequest& request, int i, const Precision& precision) {
  return with_scalar(precision, [&]<Scalar S>() { return halving_run_in<S>(request, i); });
}

std::string to_result(const HalvingRun& run) {
  return dumped({{"steps", run.steps},
                 {"q", run.q},
                 {"p", run.p},
                 {"lambda", run.lambda},
                 {"H0", run.H0},
                 {"e_H", run.e_H},
                 {"e_g", run.e_g},
                 {"e_hid", run.e_hid}},
                -1);
}

HalvingRun read_halving_run(const std::string& text) {
  return read_json(text, "a table of step halvings", [](const OrderedJson& j) {
    return HalvingRun{j.at("steps"), j.at("q"),   j.at("p"),   j.at("lambda"),
                      j.at("H0"),    j.at("e_H"), j.at("e_g"), j.at("e_hid")};
  });
}

std::vector<HalvingRow> halving_rows(const HalvingRequest& request, const std::vector<HalvingRun>& runs,
                                     const Precision& precision, Digits digits) {
  return with_scalar(precision, [&]<Scalar S>() { return halving_rows_in<S>(request, runs, digits); });
}

}  // namespace hbvm::core

#include "door/measured_values.hpp"

#include <filesystem>
#include <optional>

#include "clock.hpp"
#include "hbvm/audit.hpp"
#include "hbvm/error.hpp"
#include "hbvm/reference.hpp"
#include "hbvm/run.hpp"
#include "hbvm/study.hpp"
#include "long_work/json.hpp"
#include "method/method_spec.hpp"
#include "temporary_folder.hpp"
#include "write_file.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;

/// Files that are gone afterwards.
class Files {
 public:
  explicit Files(const NamedTexts& files) {
    if (files.empty()) return;
    folder_.emplace();
    for (const auto& [name, text] : files) write_file(folder_->path() / fs::path(name).filename(), text);
  }

  std::string path(const std::string& name) const { return folder_->file(name); }
  /// The method with the path of its file, if it is "tableau:" and one of these.
  std::string with_path(std::string method, const NamedTexts& files) const {
    for (const auto& [name, text] : files)
      if (const std::string said = "tableau:" + name; method.starts_with(said))
        return "tableau:" + path(name) + method.substr(said.size());
    return method;
  }

 private:
  std::optional<TemporaryFolder> folder_;
};

/// Ends work that takes too long, and that which the caller wants to end.
class Limit {
 public:
  Limit(const std::stop_token& stop, double seconds) : asked_(stop), end_(elapsed_seconds() + seconds) {}

  std::stop_token token() const { return source_.get_token(); }
  void watch() {
    if (asked_.stop_requested() || elapsed_seconds() >= end_) source_.request_stop();
  }
  bool is_over() const { return token().stop_requested() && !asked_.stop_requested(); }

 private:
  std::stop_token asked_;
  std::stop_source source_;
  double end_;
};

hbvm::Scene scene_of(const Measure& measure) {
  const bool is_text = measure.scene.find('\n') != std::string::npos;
  hbvm::Scene scene = is_text ? hbvm::read_scene(measure.scene) : hbvm::load_scene(measure.scene);
  for (const auto& [what, value] : measure.set) scene.set(what, value);
  return scene;
}

std::optional<Number> step_of(const Measure& measure) {
  if (measure.step.empty()) return {};
  return Number(measure.step);
}

std::string json_of(const Measure& measure, Limit& limit) {
  const Files files(measure.kind == "audit" ? NamedTexts{{"scheme.toml", measure.tableau}} : measure.files);
  const auto progress = [&](auto...) { limit.watch(); };
  if (measure.kind == "audit")
    return to_json(hbvm::audit(hbvm::tableau_claims(hbvm::read_tableau(files.path("scheme.toml"))),
                               {.progress = progress, .stop = limit.token()}));
  const std::string precision = measure.precision.empty() ? "double" : measure.precision;
  std::vector<std::string> methods = measure.methods;
  for (std::string& method : methods) method = files.with_path(method, measure.files);
  if (measure.kind == "run") {
    hbvm::RunRequest request{.scene = scene_of(measure), .method = methods.front(), .until = measure.until};
    request.step = step_of(measure);
    request.precision = precision;
    request.reverse = measure.reverse;
    request.error = measure.error;
    request.every = 0;
    request.progress = progress;
    request.stop = limit.token();
    hbvm::Run found = hbvm::run(request);
    if (measure.back) {
      request.start = to_json(found);
      request.reverse = !request.reverse;
      found = hbvm::run(request);
    }
    return to_json(found);
  }
  if (measure.kind == "compare")
    return to_json(hbvm::compare_methods({.scene = scene_of(measure),
                                          .methods = methods,
                                          .step = step_of(measure),
                                          .until = measure.until,
                                          .precision = precision,
                                          .reference = measure.reference,
                                          .progress = progress,
                                          .stop = limit.token()}));
  if (measure.kind == "convergence")
    return to_json(hbvm::convergence({.scene = scene_of(measure),
                                      .methods = methods,
                                      .steps = measure.steps,
                                      .until = Number(measure.until),
                                      .precisions = {precision},
                                      .progress = progress,
                                      .stop = limit.token()}));
  hbvm::ReferenceRequest request{.scene = scene_of(measure), .times = {measure.until}};
  if (!measure.digits.empty()) {
    const std::optional<int> digits = whole_number(measure.digits);
    if (!digits) throw InputError("'" + measure.digits + "' is no whole number of digits");
    request.digits = *digits;
  }
  request.progress = progress;
  request.stop = limit.token();
  return to_json(hbvm::reference(request));
}

}  // namespace

NamedTexts measured_values(const Measure& measure, const std::stop_token& stop, double seconds) {
  Limit limit(stop, seconds);
  std::string json;
  try {
    json = json_of(measure, limit);
  } catch (const Interrupted&) {
    if (!limit.is_over()) throw;
    throw InputError("what is asked for takes longer than a minute: choose longer steps or a shorter time");
  }
  const OrderedJson result = read_json(json, measure.kind, [](OrderedJson parsed) { return parsed; });
  NamedTexts numbers;
  for (const auto& [name, pointer] : measure.values) {
    OrderedJson value;
    try {
      value = result.at(OrderedJson::json_pointer(pointer));
    } catch (const OrderedJson::exception&) {
      throw InputError("the result of " + measure.kind + " has no " + pointer);
    }
    if (value.is_null()) throw InputError("there is no " + pointer + " to be measured here");
    numbers.emplace_back(name, value.is_string() ? value.get<std::string>() : value.dump());
  }
  return numbers;
}

}  // namespace hbvm::core

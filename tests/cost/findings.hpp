#pragma once

#include "cost/cost_study.hpp"
#include "step/registry.hpp"

namespace hbvm::core {

/// A study with findings that are given, not measured.
struct Given {
  CostStudy study{load_scene("double_pendulum"), Expression::parse("10")};
  CostOutcome outcome;

  void add(const char* method, const char* precision, long steps, double digits, double seconds,
           double calibration = 0.001) {
    CostFinding f{{parse_method(method), Precision::parse(precision), steps}, {}};
    f.measured.method = method;
    f.measured.errors = {-digits, -digits - 1, -digits};
    f.measured.raw = {-digits, -digits / 2, -digits / 2};
    f.measured.seconds = seconds;
    f.measured.calibration = calibration;
    f.measured.repetitions = 3;
    f.measured.account = {{"uniform_gravity", AccountLine::Kind::effect},
                          {"corrections", AccountLine::Kind::in_double}};
    f.measured.account[0].seconds = 1;
    f.measured.account[1].seconds = 3;
    outcome.findings.push_back(std::move(f));
    ++outcome.cells;
  }
};

/// Two methods in two precisions.
inline Given some_findings() {
  Given given;
  given.outcome.reference.digits = 50;
  given.add("rattle", "double", 10, 2, 0.01);
  given.add("rattle", "double", 100, 4, 0.1);
  given.add("hbvm:4,4", "double", 10, 6, 0.02);
  given.add("hbvm:4,4", "double", 20, 9, 0.04);
  given.add("hbvm:4,4", "mpfr:30", 40, 12, 1);
  given.add("hbvm:4,4", "mpfr:30", 80, 15, 2);
  return given;
}

}  // namespace hbvm::core

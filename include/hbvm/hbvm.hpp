#pragma once

/// All that the program can, for C++. Requests are structs to be filled, results are structs of exact decimal text and
/// doubles, and to_json() of a result is what the program prints. Nothing here is a template, and nothing needs Eigen.
/// The headers below hbvm/core are for methods, effects, constraints and loops of one's own.

#include "hbvm/audit.hpp"
#include "hbvm/cost.hpp"
#include "hbvm/error.hpp"
#include "hbvm/figure.hpp"
#include "hbvm/horizon.hpp"
#include "hbvm/lesson.hpp"
#include "hbvm/method.hpp"
#include "hbvm/nodes.hpp"
#include "hbvm/number.hpp"
#include "hbvm/order.hpp"
#include "hbvm/periodic.hpp"
#include "hbvm/precision.hpp"
#include "hbvm/reference.hpp"
#include "hbvm/results.hpp"
#include "hbvm/run.hpp"
#include "hbvm/scene.hpp"
#include "hbvm/scheme.hpp"
#include "hbvm/section.hpp"
#include "hbvm/solver.hpp"
#include "hbvm/study.hpp"
#include "hbvm/table.hpp"
#include "hbvm/tangent.hpp"
#include "hbvm/version.hpp"

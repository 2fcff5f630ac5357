#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "cost/cost_study.hpp"
#include "hbvm/figure.hpp"
#include "hbvm/table.hpp"
#include "report/csvw.hpp"

namespace hbvm::core {

/// What a finding's loop beside it took, over the median of those of its precision: more than 1 where the machine was
/// slower.
std::vector<double> slowdowns(const std::vector<CostFinding>& findings);

/// The seconds of each finding, corrected where the loop beside it shows that the machine was slower or faster.
std::vector<double> corrected_seconds(const std::vector<CostFinding>& findings);

/// A row a cell. \param study for the quantity by which the front is made
Table cost_table(const CostStudy& study, const CostOutcome& outcome);
/// What its columns are.
std::vector<CsvColumn> cost_columns();

/// What those of step_time_table and energy_table are.
std::vector<CsvColumn> further_cost_columns(const Table& table);

/// The cheapest cell for some numbers of digits.
Table cheapest_table(const CostStudy& study, const CostOutcome& outcome);

/// {"version", "command", "scene", "until", "quantity", "digits_lost", "reference", "system", "cells": [...]}
std::string to_json(const CostStudy& study, const CostOutcome& outcome, const std::string& command);

/// Time against the error, a panel a precision and one of them all.
Figure work_precision_figure(const CostStudy& study, const CostOutcome& outcome);
/// The least time for so many digits, a curve a family of methods.
Figure digits_figure(const CostStudy& study, const CostOutcome& outcome);
/// Where the time of a step goes, a bar for each precision. The bar is of the run of HBVM on the front with the most
/// digits that the precision is for.
Figure breakdown_figure(const CostStudy& study, const CostOutcome& outcome);

/// All of these, and those of steps and energies, as far as something was measured for them.
std::vector<Figure> cost_figures(const CostStudy& study, const CostOutcome& outcome);

/// What the time of a step goes into.
inline constexpr std::array<std::string_view, 6> cost_parts{
    "forces", "constraints", "products", "corrections", "linear algebra, in double", "rest"};
/// The shares of these in the time of an account, from 0 to 1.
/// \param all_in_double whether the run itself is, so that its factors and solutions are the same linear algebra
std::array<double, cost_parts.size()> part_shares(const std::vector<AccountLine>& account, bool all_in_double);

}  // namespace hbvm::core

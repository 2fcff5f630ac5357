#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "hbvm/figure.hpp"

namespace hbvm::core::speed {

/// One ratio.
struct Row {
  std::string work, against;
  double ratio = 0;
  double limit = 0;  ///< 0: none
  bool at_least = false;
  std::string detail;
  bool met() const { return at_least ? ratio >= limit : ratio <= limit; }
};

struct Group {
  std::string name, title;
  std::function<std::vector<Row>()> measure;
};

/// In the order in which they are printed.
std::vector<Group> groups();

std::vector<Row> double_rows();
std::vector<Row> best_rows();
std::vector<Row> quad_rows();
std::vector<Row> mpfr_rows();
std::vector<Row> raw_rows();
std::vector<Row> node_rows();
std::vector<Row> chain_rows();
std::vector<Row> scene_rows();

/// Time per step against digits, against s, and against the number of bodies; writes its CSV files into the folder.
Figure cost_figure(const std::filesystem::path& folder);

}  // namespace hbvm::core::speed

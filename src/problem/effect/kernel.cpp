#include "problem/effect/kernel.hpp"

#include "problem/effect/kernel_table.hpp"

namespace hbvm::core {

const Kernel* find_kernel(const Program<double>& program, Index dimension) {
  const std::string code = cpp_text(program, dimension);
  for (const Kernel& kernel : kernel_table())
    if (kernel.code == code) return &kernel;
  return nullptr;
}

std::optional<KernelSite> kernel_site(const Displacement<double>& x) {
  if (x.blocks.empty() || x.blocks.size() > 2 || x.blocks[0].weight != 1) return std::nullopt;
  KernelSite site{x.blocks[0].offset};
  if (x.blocks.size() == 2) {
    if (x.blocks[1].weight != -1 || x.shift.size() > 0) return std::nullopt;
    site.b = x.blocks[1].offset;
  }
  for (Index j = 0; j < x.shift.size(); ++j) site.shift[static_cast<std::size_t>(j)] = x.shift[j];
  return site;
}

std::optional<KernelUse> KernelUse::find(const Program<double>& program, Index dimension,
                                         const std::vector<Displacement<double>>& displacements,
                                         const Matrix<double>& coefficients) {
  KernelUse use;
  use.kernel_ = find_kernel(program, dimension);
  if (use.kernel_ == nullptr) return std::nullopt;
  for (std::size_t n = 0; n < displacements.size(); ++n) {
    std::optional<KernelSite> site = kernel_site(displacements[n]);
    if (!site) return std::nullopt;
    std::vector<double>& own = use.coefficients_.emplace_back();
    for (Index j = 0; j < coefficients.cols(); ++j) own.push_back(coefficients(static_cast<Index>(n), j));
    site->coefficients = own.data();
    use.sites_.push_back(*site);
  }
  return use;
}

}  // namespace hbvm::core

#include "hbvm/problem/effect/kernel.hpp"

#include "problem/effect/kernel_table.hpp"

namespace hbvm {

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

}  // namespace hbvm

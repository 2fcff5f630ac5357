// Prints C++ for the gradient of every effect in double: effect_kernels > effect_kernels.cpp, during the build.
//
// The code of an effect depends on the dimension, on which whole numbers its keys are, and on zeros in its vectors. All
// combinations of a few values are traced, and each code that comes out is printed once.

#include <fmt/format.h>

#include <iostream>
#include <set>

#include "hbvm/error.hpp"
#include "hbvm/problem/effect/kernel.hpp"
#include "hbvm/problem/effect/use.hpp"

namespace hbvm {
namespace {

/// Times 1/2: 0, 2, 3, 4, and a value that is not whole.
constexpr std::array shapes{0, 4, 6, 8, 5};

class Generator {
 public:
  template <class Effect>
  void effect() {
    for (const Index dimension : {2, 3}) {
      EffectUse<double> use;
      use.kind = Effect::kind;
      use.dimension = dimension;
      EffectUse<double>::Instance body;
      body.x.blocks = {{0, 1}};
      body.mass_matrix = Matrix<double>::Identity(dimension, dimension);
      use.instances = {body};
      vary(use, Effect::keys.data(), Effect::keys.data() + Effect::keys.size());
    }
  }

  void print(std::ostream& out) const {
    out << "#include <cmath>\n\n#include \"problem/effect/kernel_loop.hpp\"\n"
           "#include \"problem/effect/kernel_table.hpp\"\n\nnamespace hbvm {\nnamespace {\n\n"
        << formulas_ << "constexpr Kernel kernels[] = {\n"
        << table_ << "};\n\n}  // namespace\n\nstd::span<const Kernel> kernel_table() { return kernels; }\n\n"
        << "}  // namespace hbvm\n";
  }

 private:
  void vary(EffectUse<double>& use, const EffectKey* key, const EffectKey* end) {
    if (key == end) {
      add(use);
    } else if (key->is_vector) {
      const auto d = static_cast<std::size_t>(use.dimension);
      for (const int first : {0, 1}) {
        use.vectors[std::string(key->name)] = std::vector<double>(d, first);
        use.vectors[std::string(key->name)].back() = 1;
        vary(use, key + 1, end);
      }
    } else {
      for (const int twice : shapes) {
        use.numbers[std::string(key->name)] = static_cast<double>(twice) / 2;
        vary(use, key + 1, end);
      }
    }
  }

  void add(const EffectUse<double>& use) {
    try {
      const EffectTerm<double> term = make_term(use);
      if (term.constant_force) return;
      const std::string text = cpp_text(term.gradient, use.dimension);
      if (!known_.insert(text).second) return;
      const std::size_t number = known_.size();
      formulas_ += fmt::format(
          "/// {0}\nstruct Formula{1} {{\n  static constexpr Index dimension = {2};\n  static void "
          "gradient([[maybe_unused]] "
          "const double* x, [[maybe_unused]] const double* c, double* g) {{\n{3}  }}\n}};\n\n",
          use.kind, number, use.dimension, text);
      table_ += fmt::format("    {{R\"({0})\", add_force<Formula{1}>}},\n", text, number);
    } catch (const InputError&) {
      // not a value this key takes
    }
  }

  std::set<std::string> known_;
  std::string formulas_, table_;
};

template <class... Effect>
void add_all(Generator& generator, std::tuple<Effect...>*) {
  (generator.effect<Effect>(), ...);
}

}  // namespace
}  // namespace hbvm

// An exception stops the build.
int main() {  // NOLINT(bugprone-exception-escape)
  hbvm::Generator generator;
  hbvm::add_all(generator, static_cast<hbvm::Effects*>(nullptr));
  generator.print(std::cout);
}

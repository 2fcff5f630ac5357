// Prints C++ for the gradient of every effect in double: effect_kernels > effect_kernels.cpp, during the build.
//
// The code of an effect depends on the dimension, on which whole numbers its keys are, and on zeros in its vectors. All
// combinations of a few values are traced, and each code that comes out is printed once. Of fields of one centre, which
// have their distance in common, any two have a kernel together, too.

#include <fmt/format.h>

#include <iostream>
#include <set>

#include "hbvm/error.hpp"
#include "problem/effect/input.hpp"
#include "problem/effect/joint_program.hpp"
#include "problem/effect/kernel.hpp"

namespace hbvm::core {
namespace {

/// Times 1/2: 0, 2, 3, 4, and a value that is not whole.
constexpr std::array shapes{0, 4, 6, 8, 5};

class Generator {
 public:
  /// Kernels of that effect.
  template <class Effect>
  void effect() {
    for_each_term<Effect>(
        [&](const EffectTerm<double>& term, Index dimension) { add(Effect::kind, term.gradient, dimension, 1); });
  }

  /// Kernels of both, in that order.
  template <class First, class Second>
  void pair() {
    for_each_term<First>([&](const EffectTerm<double>& first, Index dimension) {
      for_each_term<Second>([&](const EffectTerm<double>& second, Index other) {
        if (dimension != other) return;
        const auto part = [](const EffectTerm<double>& term) {
          return JointPart<double>{&term.gradient, static_cast<std::size_t>(term.gradient_coefficients.cols())};
        };
        const JointProgram<double> both =
            join<double>({part(first), part(second)}, static_cast<std::size_t>(dimension));
        add(fmt::format("{} and {}", First::kind, Second::kind), both.program, dimension, 2);
      });
    });
  }

  void print(std::ostream& out) const {
    out << "#include <cmath>\n\n#include \"problem/effect/kernel_loop.hpp\"\n"
           "#include \"problem/effect/kernel_table.hpp\"\n\nnamespace hbvm::core {\nnamespace {\n\n"
        << formulas_ << "constexpr Kernel kernels[] = {\n"
        << table_ << "};\n\n}  // namespace\n\nstd::span<const Kernel> kernel_table() { return kernels; }\n\n"
        << "}  // namespace hbvm::core\n";
  }

 private:
  /// f(term, dimension) for each combination of values whose force varies.
  template <class Effect, class F>
  void for_each_term(F f) {
    for (const Index dimension : {2, 3}) {
      EffectInput<double> input;
      input.kind = Effect::kind;
      input.dimension = dimension;
      EffectInput<double>::Instance body;
      body.x.blocks.push_back({0, 1});
      body.mass_matrix = Matrix<double>::Identity(dimension, dimension);
      input.instances = {body};
      vary(input, Effect::keys.data(), Effect::keys.data() + Effect::keys.size(), f);
    }
  }

  template <class F>
  void vary(EffectInput<double>& input, const EffectKey* key, const EffectKey* end, const F& f) {
    if (key == end) {
      try {
        const EffectTerm<double> term = make_term(input);
        if (!term.constant_force) f(term, input.dimension);
      } catch (const InputError&) {
        // not a value this key takes
      }
    } else if (key->is_vector) {
      const auto d = static_cast<std::size_t>(input.dimension);
      for (const int first : {0, 1}) {
        input.vectors[std::string(key->name)] = std::vector<double>(d, first);
        input.vectors[std::string(key->name)].back() = 1;
        vary(input, key + 1, end, f);
      }
    } else {
      for (const int twice : shapes) {
        input.numbers[std::string(key->name)] = static_cast<double>(twice) / 2;
        vary(input, key + 1, end, f);
      }
    }
  }

  void add(std::string_view name, const Program<double>& program, Index dimension, Index effects) {
    const std::string text = cpp_text(program, dimension);
    if (!known_.insert(text).second) return;
    const std::size_t number = known_.size();
    formulas_ += fmt::format(
        "/// {0}\nstruct Formula{1} {{\n  static constexpr Index dimension = {2}, effects = {3};\n  static void "
        "gradient([[maybe_unused]] const double* x, [[maybe_unused]] const double* c, double* g) {{\n{4}  }}\n",
        name, number, dimension, effects, text);
    if (const std::string steps = cpp_steps(program, dimension); !steps.empty())
      formulas_ += fmt::format(
          "  static constexpr Index temporaries = {0};\n  template <class XOf, class Add, Index size>\n  static void "
          "gradients(Index lanes, XOf x_of, [[maybe_unused]] const double* c, double (*t)[size], Add add) {{\n{1}  "
          "}}\n",
          program.temporaries(), steps);
    formulas_ += "};\n\n";
    table_ += fmt::format("    {{R\"({0})\", add_force<Formula{1}>}},\n", text, number);
  }

  std::set<std::string> known_;
  std::string formulas_, table_;
};

template <class... Effect>
void add_all(Generator& generator, std::tuple<Effect...>*) {
  (generator.effect<Effect>(), ...);
}

template <class Field, class... Other>
void add_pairs_of(Generator& generator) {
  const auto both = [&]<class Second>(std::type_identity<Second>) {
    generator.pair<Field, Second>();
    generator.pair<Second, Field>();
  };
  (both(std::type_identity<Other>()), ...);
}

}  // namespace
}  // namespace hbvm::core

// An exception stops the build.
int main() {  // NOLINT(bugprone-exception-escape)
  hbvm::core::Generator generator;
  hbvm::core::add_all(generator, static_cast<hbvm::core::Effects*>(nullptr));
  hbvm::core::add_pairs_of<hbvm::core::CentralGravity, hbvm::core::RadialCosine, hbvm::core::Oblateness>(generator);
  generator.print(std::cout);
}

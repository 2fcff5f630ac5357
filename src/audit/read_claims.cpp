#include <algorithm>
#include <filesystem>

#include "audit/claims.hpp"
#include "method/method_spec.hpp"
#include "read_file.hpp"
#include "scalar/literal.hpp"
#include "scene/assemble.hpp"
#include "step/hbvm_method.hpp"
#include "step/registry.hpp"
#include "step/tableau_method.hpp"
#include "toml/toml_table.hpp"

namespace hbvm::core {
namespace {

/// A file that stands beside the claims' file, or the name as it is.
std::string located(const std::string& name, const std::filesystem::path& folder) {
  const std::filesystem::path beside = folder / name;
  std::error_code ignored;
  return std::filesystem::is_regular_file(beside, ignored) ? beside.string() : name;
}

/// As parse_method has it, with files beside the claims' file first; a name of no family is a file with a tableau.
MethodPtr method_of(const std::string& text, const std::filesystem::path& folder) {
  const MethodSpec spec = MethodSpec::parse(text);
  const bool is_file = !is_method_name(spec.family);
  if (!is_file && spec.family != "tableau") return parse_method(text);
  const auto [name, formulation] = FormulatedName::parse(is_file ? text : spec.arguments);
  return tableau_method(located(name, folder) + formulation.suffix());
}

int counted_from_one(TomlTable& reader, const char* key) {
  const long value = reader.take(key) ? reader.integer(key) : 1;
  if (value < 1 || value > max_k)
    reader.fail(std::string("'") + key + "' must be between 1 and " + std::to_string(max_k));
  return static_cast<int>(value) - 1;
}

/// False if absent.
bool flag(TomlTable& reader, const char* key) {
  const toml::node* const node = reader.take(key);
  if (!node) return false;
  if (!node->is_boolean()) reader.fail(*node, "'" + std::string(key) + "' is true or false");
  return node->value_or(false);
}

Perturbation perturbation(TomlTable reader) {
  using Part = Perturbation::Part;
  const std::string name = reader.string("part");
  std::optional<Part> part;
  for (const auto& [own, value] : {std::pair("node", Part::node),
                                   {"weight", Part::weight},
                                   {"integral", Part::integral},
                                   {"X", Part::X},
                                   {"legendre", Part::legendre}})
    if (name == own) part = value;
  if (!part) reader.fail("unknown part '" + name + "': use node, weight, integral, X or legendre");
  const bool hat = flag(reader, "hat");
  Perturbation result{*part, hat, counted_from_one(reader, "i"), counted_from_one(reader, "j"),
                      reader.number("relative")};
  reader.finish();
  return result;
}

class ClaimReader {
 public:
  ClaimReader(TomlTable table, const std::filesystem::path& folder) : reader_(std::move(table)), folder_(folder) {}

  Claim read() {
    Claim claim;
    claim.label = string_or("label", "stated");
    const std::string quantity = reader_.string("quantity");
    checked([&] { claim.quantity = parse_quantity(quantity); });
    const bool of_coefficients = claim.quantity >= Quantity::order_conditions;
    claim.problem =
        !of_coefficients || reader_.take("problem") ? located(reader_.string("problem"), folder_) : "tableau";
    if (of_coefficients) claim.problem = "tableau";
    const std::string method = reader_.string("method");
    checked([&] {
      claim.method = method_of(method, folder_);
      const HbvmMethod* const hbvm = as_hbvm(*claim.method);
      if (hbvm && hbvm->name().is_auto()) throw InputError("method " + method + ": a claim states its k");
    });
    const std::string over = string_or("over", "interval");
    if (over != "interval" && over != "step") reader_.fail("unknown 'over' \"" + over + "\": use interval or step");
    claim.span = over == "step" ? Span::step : Span::interval;
    const std::string form = string_or("form", "at least");
    if (form != "at least" && form != "exactly")
      reader_.fail("unknown form '" + form + "': use 'at least' or 'exactly'");
    claim.form = form == "exactly" ? Form::exactly : Form::at_least;
    read_rate(claim);
    claim.of_degenerate_motion = flag(reader_, "degenerate");
    if (const toml::node* const node = reader_.take("perturb")) {
      if (!node->is_table()) reader_.fail(*node, "'perturb' is a table");
      const HbvmMethod* const hbvm = as_hbvm(*claim.method);
      if (!hbvm) reader_.fail(*node, "'perturb' is for hbvm:K,S; a tableau is changed in its own file");
      const Perturbation wrong = perturbation(TomlTable(reader_.source(), *node->as_table(), "perturb"));
      checked([&] { claim.method = hbvm_of(hbvm->name(), wrong); }, node);
    }
    reader_.finish();
    refuse_nonsense(claim);
    return claim;
  }

 private:
  /// With the line of what is wrong, or that of the claim.
  template <class F>
  void checked(const F& f, const toml::node* node = nullptr) const {
    try {
      f();
    } catch (const InputError& error) {
      if (node) reader_.fail(*node, error.what());
      reader_.fail(error.what());
    }
  }

  std::string string_or(const char* key, const char* absent) {
    return reader_.take(key) ? reader_.string(key) : absent;
  }

  void read_rate(Claim& claim) {
    const toml::node& node = reader_.require("rate");
    if (node.is_string() && node.value_or(std::string()) == "round-off") {
      claim.form = Form::round_off;
      return;
    }
    const Constants constants = claim.method->parameters();
    const Expression rate = reader_.to_number(node, "'rate'");
    checked([&] { claim.predicted = evaluate<double>(rate, constants); }, &node);
    if (!(claim.predicted >= 0 && claim.predicted <= 2 * max_k + 1)) reader_.fail(node, "no such rate");
  }

  void refuse_nonsense(const Claim& claim) const {
    const Quantity q = claim.quantity;
    const std::string name(name_of(q));
    if (q >= Quantity::order_conditions) return refuse_of_coefficients(claim);
    if (q >= Quantity::hidden_constant) reader_.fail("quantity '" + name + "' has no rate to claim");
    if (q == Quantity::polynomials && claim.span != Span::step)
      reader_.fail("quantity '" + name + "' is one of a step: over = \"step\"");
    const bool conserved = q == Quantity::g || q == Quantity::hidden || q == Quantity::H || q == Quantity::balance ||
                           q == Quantity::angular_momentum || q == Quantity::reversal;
    if (claim.form == Form::round_off && !conserved)
      reader_.fail("only g, hidden, H, balance, angular momentum and reversal can be 0 to round-off");
    const bool of_polynomials = q == Quantity::polynomials || q == Quantity::delta_lambda;
    if (of_polynomials && !as_hbvm(*claim.method))
      reader_.fail("quantity '" + name + "' is of the polynomials of hbvm:K,S, and " + claim.method->text() +
                   " has none");
    if (claim.form != Form::round_off && q == Quantity::g && !is_general(claim.problem))
      reader_.fail("quantity 'g' is claimed with rate = \"round-off\": all constraints of " + claim.problem +
                   " are quadratic");
    if (claim.form != Form::round_off && q == Quantity::reversal)
      reader_.fail("quantity '" + name + "' is claimed with rate = \"round-off\"");
    if (q == Quantity::angular_momentum && claim.form != Form::round_off && claim.span == Span::step)
      reader_.fail("the angular momentum is looked at over an interval");
    checked([&] { static_cast<void>(load_scene(claim.problem)); });
  }

  /// A tableau has an order, powers to which B, C and D hold, and symmetry; HBVM conditions that hold or do not.
  void refuse_of_coefficients(const Claim& claim) const {
    const Quantity q = claim.quantity;
    const std::string name(name_of(q));
    const bool round_off = claim.form == Form::round_off;
    if (as_tableau(*claim.method)) {
      if (q == Quantity::X || q == Quantity::W) reader_.fail("quantity '" + name + "' is of hbvm:K,S");
      if (round_off != (q == Quantity::symmetry))
        reader_.fail(round_off ? "quantity '" + name + "' of a tableau is claimed with a number, as rate = 4"
                               : "quantity 'symmetry' is claimed with rate = \"round-off\"");
    } else if (as_hbvm(*claim.method)) {
      if (q == Quantity::order_conditions) reader_.fail("quantity '" + name + "' is of a tableau");
      if (!round_off) reader_.fail("quantity '" + name + "' of hbvm:K,S is claimed with rate = \"round-off\"");
    } else {
      reader_.fail("method " + claim.method->text() + " has no coefficients to look at");
    }
  }

  /// Whether some constraint is not quadratic.
  static bool is_general(const std::string& problem) {
    const PrecisionScope digits(30);  // whose range holds whatever a scene may
    return degree_of_g(assemble<Mpfr>(load_scene(problem)).problem) != 2;
  }

  TomlTable reader_;
  const std::filesystem::path& folder_;
};

}  // namespace

std::vector<Claim> read_claims(const std::string& path) {
  const TomlSource source(read_file(path), path);
  const toml::table root = source.parse();
  TomlTable top(source, root, "claims");
  std::vector<Claim> claims;
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  for (const toml::table* const table : top.tables("claim"))
    claims.push_back(
        ClaimReader(TomlTable(source, *table, "claim " + std::to_string(claims.size() + 1)), folder).read());
  top.finish();
  if (claims.empty()) source.fail(1, "there is no [[claim]]");
  return claims;
}

}  // namespace hbvm::core

#include "reference/store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "hbvm/error.hpp"
#include "scalar/text.hpp"
#include "toml/toml_table.hpp"

namespace hbvm::core {
namespace {

constexpr const char* format_name = "hbvm reference, format 1";

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c < ' ' && c >= 0 ? ' ' : c;
  }
  return result + '"';
}

std::string list(const char* key, const std::vector<std::string>& texts) {
  std::string result = std::string(key) + " = [";
  for (std::size_t i = 0; i < texts.size(); ++i) result += (i > 0 ? ",\n  " : "\n  ") + quoted(texts[i]);
  return result + (texts.empty() ? "]\n" : "\n]\n");
}

std::vector<std::string> decimals(TomlTable& table, const char* key) {
  std::vector<std::string> result = table.strings(key);
  for (const std::string& text : result)
    if (!is_decimal(text)) table.fail(std::string("'") + key + "' holds '" + text + "', which is no decimal");
  return result;
}

std::string decimal(TomlTable& table, const char* key) {
  std::string text = table.string(key);
  if (!is_decimal(text)) table.fail(std::string("'") + key + "' is no decimal");
  return text;
}

template <class Read>
void for_each_table(const TomlSource& source, TomlTable& root, const char* key, const Read& read) {
  for (const toml::table* const entry : root.tables(key)) {
    TomlTable table(source, *entry, key);
    read(table);
    table.finish();
  }
}

}  // namespace

std::string to_toml(const StoredReference& stored) {
  const Reference& r = stored.reference;
  std::string text =
      fmt::format("format = {}\nscene = {}\nscene_hash = {}\ndigits = {}\ndigits_lost = {}\nversion = {}\ndate = {}\n",
                  quoted(format_name), quoted(r.scene), quoted(r.scene_hash), r.digits,
                  quoted(fmt::format("{:.2f}", r.digits_lost)), quoted(stored.version), quoted(stored.date));
  if (r.proved > 0) text += fmt::format("proved = {}\n", r.proved);
  text += list("momenta", r.momentum_names);
  if (!r.observed_names.empty()) text += list("observed", r.observed_names);
  for (const RouteReport& route : r.routes)
    text += fmt::format("\n[[route]]\nname = {}\nsettings = {}\ncpu_seconds = {}\n", quoted(route.name),
                        quoted(route.settings), quoted(fmt::format("{:.3f}", route.cpu_seconds)));
  for (const ReferenceState& state : r.times) {
    text += fmt::format("\n[[time]]\nt = {}\nagreed = {}\n", quoted(state.t), state.agreed);
    text += list("q", state.q) + list("p", state.p) + list("lambda", state.lambda);
    text += "H = " + quoted(state.H) + "\n" + list("momenta", state.momenta);
    if (!state.observed.empty()) text += list("observed", state.observed);
    if (state.radius) text += list("radius", {state.radius->q, state.radius->p, state.radius->lambda, state.radius->H});
  }
  return text;
}

StoredReference read_reference(const std::string& toml, const std::string& name) {
  const TomlSource source(toml, name);
  const toml::table parsed = source.parse();
  TomlTable root(source, parsed, "the reference");
  if (!root.has("format") || root.string("format") != format_name)
    root.fail(std::string("it does not begin with format = \"") + format_name + "\"");
  StoredReference stored;
  Reference& r = stored.reference;
  r.scene = root.string("scene");
  r.scene_hash = root.string("scene_hash");
  r.digits = static_cast<int>(root.integer("digits"));
  r.digits_lost = std::stod(decimal(root, "digits_lost"));
  stored.version = root.string("version");
  stored.date = root.string("date");
  if (root.has("proved")) r.proved = static_cast<int>(root.integer("proved"));
  r.momentum_names = root.strings("momenta");
  if (root.has("observed")) r.observed_names = root.strings("observed");
  for_each_table(source, root, "route", [&](TomlTable& table) {
    RouteReport route{table.string("name"), table.string("settings")};
    route.cpu_seconds = std::stod(decimal(table, "cpu_seconds"));
    r.routes.push_back(std::move(route));
  });
  for_each_table(source, root, "time", [&](TomlTable& table) {
    ReferenceState state;
    state.t = table.string("t");
    state.agreed = table.integer("agreed");
    state.q = decimals(table, "q");
    state.p = decimals(table, "p");
    state.lambda = decimals(table, "lambda");
    state.H = decimal(table, "H");
    state.momenta = decimals(table, "momenta");
    if (table.has("observed")) state.observed = decimals(table, "observed");
    if (table.has("radius")) {
      // Of q, p, lambda and H.
      const std::vector<std::string> radius = decimals(table, "radius");
      if (radius.size() != 4) table.fail("'radius' has not four numbers");
      state.radius = {radius[0], radius[1], radius[2], radius[3]};
    }
    if (state.p.size() != state.q.size()) table.fail("'q' and 'p' have different lengths");
    if (state.momenta.size() != r.momentum_names.size()) table.fail("'momenta' has not a number for each name");
    if (state.observed.size() != r.observed_names.size()) table.fail("'observed' has not a number for each name");
    r.times.push_back(std::move(state));
  });
  root.finish();
  return stored;
}

std::optional<FoundReference> find_reference(const Scene& scene, const Expression& t, int digits) {
  // Expressions are rounded correctly: those of one value give one number.
  constexpr int bits = 1024;
  const auto instant = [&](const Expression& time) { return time.evaluate_to_bits(bits, scene.constants); };
  const BigFloat wanted = instant(t);
  const std::string hash = scene_hash(scene);
  std::optional<FoundReference> best;
  for (const auto& [name, text] : shipped_references()) {
    if (text.find(hash) == std::string::npos) continue;
    const Reference reference = read_reference(text, name).reference;
    if (reference.scene_hash != hash || reference.digits < digits || (best && best->digits >= reference.digits))
      continue;
    for (const ReferenceState& state : reference.times)
      if (mpfr_equal_p(raw(instant(Expression::parse(state.t))), raw(wanted)) != 0)
        best = FoundReference{name, reference.digits, state, reference.proved};
  }
  return best;
}

std::vector<Difference> differences(const Reference& stored, const Reference& found) {
  std::vector<Difference> result;
  const auto compare = [&](const std::string& t, const std::string& what, const std::vector<std::string>& a,
                           const std::vector<std::string>& b) {
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
      const std::string x = i < a.size() ? a[i] : "nothing", y = i < b.size() ? b[i] : "nothing";
      if (x != y) result.push_back({t, a.size() == 1 && what == "H" ? what : fmt::format("{}_{}", what, i + 1), x, y});
    }
  };
  for (std::size_t n = 0; n < std::max(stored.times.size(), found.times.size()); ++n) {
    static const ReferenceState none{};
    const ReferenceState& a = n < stored.times.size() ? stored.times[n] : none;
    const ReferenceState& b = n < found.times.size() ? found.times[n] : none;
    const std::string& t = a.t.empty() ? b.t : a.t;
    if (a.t != b.t) result.push_back({t, "time", a.t, b.t});
    compare(t, "q", a.q, b.q);
    compare(t, "p", a.p, b.p);
    compare(t, "lambda", a.lambda, b.lambda);
    compare(t, "H", {a.H}, {b.H});
    compare(t, "momentum", a.momenta, b.momenta);
    if (!stored.observed_names.empty()) compare(t, "observed", a.observed, b.observed);
  }
  return result;
}

}  // namespace hbvm::core

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "door/door.hpp"
#include "hbvm/error.hpp"
#include "hbvm/scheme.hpp"
#include "long_work/json.hpp"
#include "method/order_conditions.hpp"
#include "report/junit.hpp"
#include "scalar/mpfr.hpp"
#include "scheme/facts.hpp"
#include "scheme/families.hpp"
#include "scheme/repair.hpp"

namespace hbvm {
namespace {

using core::Repair;
using core::SchemeText;

/// What a scheme is held to, and what it is found to be.
class SchemeJudge {
 public:
  SchemeJudge(SchemeText text, int most_mended)
      : text_(std::move(text)),
        most_mended_(most_mended),
        scheme_(core::make_scheme(text_)),
        rounding_(core::Rounding::of(*scheme_, said_digits())),
        scope_(rounding_.working_digits),
        values_(scheme_->written_values<Mpfr>()) {
    for (const core::SchemeEntry& entry : scheme_->entries()) unknown_ = unknown_ || !entry.written;
    parts_ = core::met_parts(*scheme_, values_, rounding_);
    if (!said_digits() && core::Rounding::has_long_fractions(*scheme_)) try_rounded_fractions();
  }

  SchemeAudit audit() {
    SchemeAudit found;
    found.file = text_.file;
    found.name = scheme_->name();
    found.family = scheme_->family();
    found.entries = static_cast<int>(scheme_->entries().size());
    found.digits = rounding_.digits;
    found.rounded_fractions = rounding_.of_fractions;
    if (!scheme_->consistency(values_).empty()) {
      found.rows = core::consistent_digits(*scheme_, values_);
      found.consistent = *found.rows >= enough_digits();
      found.own_nodes = !found.consistent && has_order_with_own_nodes();
      found.consistent = found.consistent || found.own_nodes;
    }
    for (const core::MetPart& part : parts_) found.orders.push_back(order_of(part));
    found.holds = found.consistent && !unknown_ &&
                  std::all_of(found.orders.begin(), found.orders.end(), [](const SchemeOrder& o) { return o.holds; });
    mend(found);
    if (!unknown_) found.facts = core::facts_of(*scheme_, values_, rounding_, parts_.front().order);
    return found;
  }

 private:
  using Mpfr = core::Mpfr;

  std::optional<int> said_digits() const {
    const auto said = text_.stated.find("digits");
    if (said == text_.stated.end()) return {};
    constexpr long most = 10'000;
    if (said->second < 1 || said->second > most)
      throw InputError(text_.file + ": 'digits' must be from 1 to " + std::to_string(most));
    return static_cast<int>(said->second);
  }

  /// To which something is met if it is met.
  double enough_digits() const {
    constexpr double lost = 2, guard = 30;
    if (rounding_.digits == 0) return rounding_.working_digits - guard;
    int least = rounding_.digits;
    for (const core::Rounding::Entry& entry : rounding_.entries) least = std::min(least, entry.digits);
    return least - lost;
  }

  /// Fractions with many digits may be rounded. They are if the method has a higher order then, to the digits to which
  /// the first conditions hold that are not met.
  void try_rounded_fractions() {
    constexpr int fewest = 12, few_orders = 2;
    if (parts_.front().stated && parts_.front().order >= *parts_.front().stated) return;
    double digits = core::digits10<Mpfr>();
    for (const core::MetOrder& met : parts_.front().each)
      if (met.order <= parts_.front().order + 1) digits = std::min(digits, met.digits);
    if (!scheme_->consistency(values_).empty()) digits = std::min(digits, core::consistent_digits(*scheme_, values_));
    if (digits < fewest || digits >= core::digits10<Mpfr>()) return;
    const core::Rounding rounded = core::Rounding::of(*scheme_, static_cast<int>(digits));
    std::vector<core::MetPart> parts = core::met_parts(*scheme_, values_, rounded);
    if (parts.front().order < std::max(few_orders, parts_.front().order + 1)) return;
    rounding_ = rounded;
    parts_ = std::move(parts);
  }

  /// Whether a Runge-Kutta method whose nodes are not the row sums has its order for y' = f(t, y), too.
  bool has_order_with_own_nodes() const {
    if (scheme_->family() != "runge_kutta" || !scheme_->has("c")) return false;
    // A wrong entry leaves some low order to any table.
    const int order = parts_.front().order,
              least = parts_.front().stated.value_or(static_cast<int>(scheme_->matrix("A", values_).rows()));
    if (order < least || order > core::max_tree_order) return false;
    const core::RungeKutta<Mpfr> method{scheme_->matrix("A", values_), scheme_->vector("b", values_),
                                        scheme_->vector("c", values_)};
    for (const int share : {-1, 1, 2})
      for (const std::vector<Mpfr>& residuals : core::order_residuals_in_time(method, order, Mpfr(share)))
        if (core::digits_met(residuals) < enough_digits()) return false;
    return true;
  }

  SchemeOrder order_of(const core::MetPart& part) const {
    SchemeOrder order{part.name, part.stated, part.order, 0, 0, false};
    for (const core::MetOrder& met : part.each) {
      if (met.order <= part.order) order.digits = met.order == 1 ? met.digits : std::min(order.digits, met.digits);
      if (met.order == part.order + 1) order.next_digits = std::max<double>(0, met.digits);
    }
    order.holds = part.order >= part.stated.value_or(1);
    return order;
  }

  Repair repair(const std::vector<int>& targets, int most) const {
    return core::repair_of(*scheme_, rounding_, targets, most);
  }

  /// For a part whose author claims nothing: the highest order that one entry, or what is unknown, brings about. It
  /// must win three conditions, as fewer may be met by chance. Embedded weights that are two orders below the method,
  /// and one below with one entry changed, are expected to be meant so. That which there is, if none does.
  int reach(std::vector<int> targets, std::size_t part) const {
    constexpr long won = 3;
    const int now = parts_[part].order, highest = scheme_->parts()[part].max_order;
    int best = unknown_ ? 0 : now, missed = 0;
    long conditions = 0;
    for (int order = unknown_ ? 1 : now + 1; order <= highest && missed < 2; ++order) {
      conditions += static_cast<long>(scheme_->residuals(part, order, values_).size());
      targets[part] = order;
      const bool is_expected = part > 0 && parts_[part].name == "embedded order" && order == parts_[0].order - 1;
      if (conditions < won && !is_expected) continue;
      const std::size_t ways = repair(targets, unknown_ ? 0 : 1).ways.size();
      if (is_expected ? ways > 0 : ways == 1) {
        best = order;
        missed = 0;
      } else {
        ++missed;
      }
    }
    return best;
  }

  void mend(SchemeAudit& found) {
    std::vector<int> targets(parts_.size(), 0);
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      targets[part] = parts_[part].stated.value_or(0);
      if (parts_[part].stated || most_mended_ == 0) continue;
      targets[part] = reach(targets, part);
      if (targets[part] > parts_[part].order && !unknown_) found.orders[part].holds = found.holds = false;
    }
    if (found.holds) return;
    if (most_mended_ == 0 && !unknown_) return;
    const Repair repaired = repair(targets, unknown_ ? std::min(1, most_mended_) : most_mended_);
    found.conditions = repaired.conditions;
    if (repaired.ways.size() != 1) {
      found.repair_says = repaired.ways.empty()
                              ? "no change of " + std::string(most_mended_ > 1 ? "one or two entries" : "one entry") +
                                    " meets all conditions"
                              : fmt::format("{} different changes meet all conditions: they do not determine one",
                                            repaired.ways.size());
      return;
    }
    SchemeText mended = text_;
    for (const core::MendedEntry& entry : repaired.ways.front()) {
      const core::SchemeEntry& place = scheme_->entries()[entry.entry];
      std::string& number = mended.arrays.at(place.key)[place.row][place.column];
      found.repair.push_back({place.name, number, entry.value, entry.exact});
      number = entry.exact.empty() ? entry.value : entry.exact;
    }
    std::string orders;
    for (std::size_t part = 0; part < targets.size(); ++part)
      if (targets[part] > 0)
        orders += fmt::format("{}{} {}", orders.empty() ? "" : ", ", parts_[part].name, targets[part]);
    found.repair_says = fmt::format("all {} conditions hold then: {}", found.conditions, orders);
    found.mended = toml(mended);
  }

  static std::string toml(const SchemeText& text) {
    std::string toml = "name = " + core::OrderedJson(text.name).dump() + "\n";
    if (!text.family.empty()) toml += "family = " + core::OrderedJson(text.family).dump() + "\n";
    for (const auto& [key, number] : text.stated) toml += fmt::format("{} = {}\n", key, number);
    const auto row = [](const std::vector<std::string>& numbers) {
      std::string list;
      for (const std::string& number : numbers) list += (list.empty() ? "" : ", ") + core::OrderedJson(number).dump();
      return "[" + list + "]";
    };
    for (const auto& [key, rows] : text.arrays) {
      const bool is_matrix = key.front() == 'A' || key == "b_theta" || rows.size() > 1;
      toml += key + " = ";
      if (!is_matrix) {
        toml += row(rows.front()) + "\n";
        continue;
      }
      toml += "[\n";
      for (const auto& numbers : rows) toml += "  " + row(numbers) + ",\n";
      toml += "]\n";
    }
    return toml;
  }

  SchemeText text_;
  int most_mended_;
  core::SchemePtr scheme_;
  core::Rounding rounding_;
  core::PrecisionScope scope_;
  std::vector<core::Mpfr> values_;
  std::vector<core::MetPart> parts_;
  bool unknown_ = false;
};

/// "-3544/2565, in place of -3554/2565".
std::string text_of(const MendedNumber& number) {
  return fmt::format("{} = {}, in place of {}", number.entry, number.exact.empty() ? number.value : number.exact,
                     number.printed);
}

std::string rows_text(const SchemeAudit& audit) {
  return fmt::format("the nodes are the row sums to {:.1f} digits only", *audit.rows);
}

std::string text_of(const SchemeOrder& order, int digits) {
  std::string text = fmt::format("{} {}", order.name, order.order);
  if (order.stated && *order.stated != order.order) text += fmt::format(" and not {} as claimed", *order.stated);
  if (order.order > 0)
    text += digits > 0 ? fmt::format("; its conditions are met to {:.1f} digits", order.digits)
                       : std::string("; its conditions are met exactly");
  if (order.next_digits > 0) text += fmt::format(", those of order {} to {:.1f}", order.order + 1, order.next_digits);
  return text;
}

}  // namespace

SchemeAudit audit_scheme(const SchemeRequest& request) {
  const core::Admitted admitted(request.stop);
  if (request.most_mended < 0 || request.most_mended > 2)
    throw InputError("a repair changes at most 0, 1 or 2 entries, and not " + std::to_string(request.most_mended));
  SchemeText text = core::read_scheme_text(request.file);
  if (request.order) text.stated["order"] = *request.order;
  if (request.embedded_order) text.stated["embedded_order"] = *request.embedded_order;
  return SchemeJudge(std::move(text), request.most_mended).audit();
}

std::string to_text(const SchemeAudit& audit) {
  std::string text = fmt::format("{}: {} numbers of family {}, {}\n", audit.name, audit.entries, audit.family,
                                 audit.digits > 0 ? fmt::format("with {} digits{}", audit.digits,
                                                                audit.rounded_fractions ? ", fractions among them" : "")
                                                  : "exact");
  for (const SchemeOrder& order : audit.orders) text += "  " + text_of(order, audit.digits) + "\n";
  if (audit.own_nodes) text += "  the nodes are not the row sums; the order is that for y' = f(t, y), too\n";
  if (audit.rows && !audit.consistent) text += "  " + rows_text(audit) + "\n";
  for (const std::string& fact : audit.facts) text += "  " + fact + "\n";
  for (const MendedNumber& number : audit.repair) text += "repair: " + text_of(number) + "\n";
  if (!audit.repair_says.empty()) text += (audit.repair.empty() ? "repair: " : "        ") + audit.repair_says + "\n";
  return text + (audit.holds ? "holds\n" : "fails\n");
}

std::string to_line(const SchemeAudit& audit) {
  std::string orders, repair;
  for (const SchemeOrder& order : audit.orders)
    orders += fmt::format("{}{} {}", orders.empty() ? "" : ", ", order.name, order.order);
  for (const MendedNumber& number : audit.repair) repair += "; " + text_of(number);
  return fmt::format("{}: {}: {}{}", audit.file, audit.holds ? "holds" : "fails", orders, repair);
}

std::string to_junit(const SchemeAudit& audit) {
  using Outcome = core::JunitCase::Outcome;
  std::vector<core::JunitCase> cases;
  const auto add = [&](const std::string& name, bool holds, const std::string& message) {
    cases.push_back(
        {.group = audit.name, .name = name, .outcome = holds ? Outcome::passed : Outcome::failed, .message = message});
  };
  for (const SchemeOrder& order : audit.orders) add(order.name, order.holds, text_of(order, audit.digits));
  if (audit.rows) add("row sums", audit.consistent, rows_text(audit));
  // Entries that are not known fail no order, but the whole.
  add("all numbers", audit.holds, to_line(audit));
  return core::junit_xml(audit.file, cases);
}

std::string to_json(const SchemeAudit& audit) {
  core::OrderedJson orders = core::OrderedJson::array(), repair = core::OrderedJson::array();
  for (const SchemeOrder& order : audit.orders)
    orders.push_back({{"name", order.name},
                      {"stated", order.stated ? core::OrderedJson(*order.stated) : core::OrderedJson(nullptr)},
                      {"order", order.order},
                      {"digits", core::json_number(order.digits)},
                      {"next_digits", core::json_number(order.next_digits)},
                      {"holds", order.holds}});
  for (const MendedNumber& number : audit.repair)
    repair.push_back({{"entry", number.entry},
                      {"printed", number.printed},
                      {"value", number.value},
                      {"exact", number.exact.empty() ? core::OrderedJson(nullptr) : core::OrderedJson(number.exact)}});
  return core::dumped({{"file", audit.file},
                       {"name", audit.name},
                       {"family", audit.family},
                       {"entries", audit.entries},
                       {"digits", audit.digits > 0 ? core::OrderedJson(audit.digits) : core::OrderedJson(nullptr)},
                       {"row_sum_digits", audit.rows ? core::json_number(*audit.rows) : core::OrderedJson(nullptr)},
                       {"consistent", audit.consistent},
                       {"own_nodes", audit.own_nodes},
                       {"orders", orders},
                       {"facts", audit.facts},
                       {"repair", repair},
                       {"conditions", audit.conditions},
                       {"repair_says", audit.repair_says},
                       {"holds", audit.holds}},
                      2);
}

}  // namespace hbvm

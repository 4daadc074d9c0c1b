#include "storage/rules.hpp"

#include <array>

#include "storage/columns.hpp"
#include "storage/cursor.hpp"
#include "storage/sites.hpp"
#include "storage/snapshot.hpp"
#include "storage/zones.hpp"

namespace raywatch {
namespace {

constexpr std::string_view kRuleList = "rules";
const std::string kSelectRules = "SELECT id, site, zone, name, spec, created_at, edited_at FROM rules ";

RuleRecord read_rule(Statement& row) {
  RuleRecord record;
  const auto id = row.take<RuleId>();
  record.site = row.take<SiteId>();
  const auto zone = row.take<std::optional<ZoneId>>();
  record.name = row.take<std::string>();
  record.rule = rule_from_json(row.take<std::string>());
  record.rule.id = id;
  record.rule.zone = zone;
  record.created_at = row.take<Time>();
  record.edited_at = row.take<Time>();
  return record;
}

void require_consistent(const Snapshot& snapshot, const RuleRecord& rule) {
  check_rule(rule.rule);
  const auto other = database_of(snapshot).find<RuleId>(
      "SELECT id FROM rules INDEXED BY rules_by_name WHERE site = ? AND name = ?", rule.site, rule.name);
  if (other && *other != rule.rule.id) throw Conflict("the site has a rule named \"" + rule.name + "\" already");
  if (!rule.rule.zone) return;
  const std::optional<ZoneRecord> zone = find_zone(snapshot, *rule.rule.zone);
  if (!zone || zone->site != rule.site) throw NotFound("the site has no such zone");
}

}  // namespace

RuleRecord default_rule(SiteId site, Profile profile) {
  RuleRecord record{.site = site, .name = "anything that lasts"};
  if (profile != Profile::survey) record.rule.persistence = {.scans = 2, .of = 3, .seconds = 20.0};
  return record;
}

RuleRecord insert_rule(Transaction& transaction, const RuleRecord& rule, Time now) {
  transaction.impl().require_room_for_records();
  if (!find_site(transaction, rule.site)) throw NotFound("there is no site " + std::to_string(rule.site.value));
  require_consistent(transaction, rule);
  Database& database = database_of(transaction);
  database.run("INSERT INTO rules (site, zone, name, spec, created_at, edited_at) VALUES (?, ?, ?, ?, ?, ?)", rule.site,
               rule.rule.zone, rule.name, rule_json(rule.rule), now, now);
  return find_rule(transaction, RuleId{database.last_id()}).value();
}

std::optional<RuleRecord> find_rule(const Snapshot& snapshot, RuleId id) {
  Statement row(database_of(snapshot), kSelectRules + "WHERE id = ?");
  if (!row.bind(id).next()) return std::nullopt;
  return read_rule(row);
}

Page<RuleRecord> list_rules(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page) {
  const auto [after] = key_before<1>(page, kRuleList, {0});
  Statement rows(
      database_of(snapshot),
      kSelectRules + (site ? "INDEXED BY rules_by_site WHERE site = ? AND " : "WHERE ") + "id > ? ORDER BY id LIMIT ?");
  if (site) rows.bind(*site);
  rows.bind(after, rows_to_read(page));
  std::vector<RuleRecord> rules;
  while (rows.next()) rules.push_back(read_rule(rows));
  return make_page(std::move(rules), page, kRuleList, [](const RuleRecord& r) { return std::array{r.rule.id.value}; });
}

std::vector<RuleRecord> rules_of(const Snapshot& snapshot, SiteId site) {
  Statement rows(database_of(snapshot), kSelectRules + "INDEXED BY rules_by_site WHERE site = ? ORDER BY id");
  rows.bind(site);
  std::vector<RuleRecord> rules;
  while (rows.next()) rules.push_back(read_rule(rows));
  return rules;
}

RuleRecord replace_rule(Transaction& transaction, const RuleRecord& rule, Time now) {
  require_consistent(transaction, rule);
  database_of(transaction)
      .run("UPDATE rules SET zone = ?, name = ?, spec = ?, edited_at = ? WHERE id = ?", rule.rule.zone, rule.name,
           rule_json(rule.rule), now, rule.rule.id);
  return find_rule(transaction, rule.rule.id).value();
}

void delete_rule(Transaction& transaction, RuleId id) {
  database_of(transaction).run("DELETE FROM rules WHERE id = ?", id);
}

Rulebook rulebook_of(const Snapshot& snapshot, SiteId site, Time from) {
  Rulebook book{.rules = {}, .zones = zones_of(snapshot, site), .silences = silences_after(snapshot, site, from)};
  for (const RuleRecord& record : rules_of(snapshot, site)) book.rules.push_back(record.rule);
  return book;
}

}  // namespace raywatch

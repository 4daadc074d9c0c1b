#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/profile.hpp"
#include "core/rule.hpp"
#include "storage/page.hpp"
#include "storage/store.hpp"

namespace raywatch {

struct RuleRecord {
  Rule rule;
  SiteId site;
  std::string name;
  Time created_at, edited_at;
};

/// What every new site starts with, so that nobody has to write a rule before being told of anything: whatever lasts.
/// Of a survey every change counts; elsewhere people pass by.
RuleRecord default_rule(SiteId site, Profile profile);

/// @throws Conflict when the site has a rule of that name; NotFound for the site, or a zone that is not the site's.
RuleRecord insert_rule(Transaction& transaction, const RuleRecord& rule, Time now);
std::optional<RuleRecord> find_rule(const Snapshot& snapshot, RuleId id);
/// Oldest first.
Page<RuleRecord> list_rules(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page);
std::vector<RuleRecord> rules_of(const Snapshot& snapshot, SiteId site);
/// Replaces everything but the site. Alerts that stand keep what they were opened by.
RuleRecord replace_rule(Transaction& transaction, const RuleRecord& rule, Time now);
void delete_rule(Transaction& transaction, RuleId id);

struct SilenceRecord {
  SilenceId id;
  SiteId site;
  Silence silence;
  std::string by, note;
  Time created_at;
};
SilenceRecord insert_silence(Transaction& transaction, const SilenceRecord& silence, Time now);
std::optional<SilenceRecord> find_silence(const Snapshot& snapshot, SilenceId id);
/// Newest first.
Page<SilenceRecord> list_silences(const Snapshot& snapshot, std::optional<SiteId> site, const PageRequest& page);
/// Those of a site that end after a moment.
std::vector<Silence> silences_after(const Snapshot& snapshot, SiteId site, Time moment);
void delete_silence(Transaction& transaction, SilenceId id);

/// All that decides about alerts of a site, for scans from `from` on.
Rulebook rulebook_of(const Snapshot& snapshot, SiteId site, Time from);

}  // namespace raywatch

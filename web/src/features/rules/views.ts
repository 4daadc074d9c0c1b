// What the table of views loads in one piece.

export { NewRuleView, RuleView } from './rule_view';
export { RulesView } from './rules_view';

// Loaded together, when the first of them is shown.

export { CompareView } from './compare_view';
export { ComparisonView } from './comparison_view';
export { ComparisonsView } from './comparisons_view';

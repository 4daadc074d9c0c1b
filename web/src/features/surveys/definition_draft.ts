// Where and how finely volumes are measured, as it is filled in: numbers are texts until they are sent.

import type { Schema } from '../../lib/api';

export interface DefinitionDraft {
  readonly zones: readonly number[];
  readonly cell_m: string;
  readonly core_spacing_m: string;
  readonly density: string;
  readonly greatest_slope_deg: string;
}

/** As the daemon has it when nothing is said. */
export const newDefinition: DefinitionDraft = {
  zones: [],
  cell_m: '1',
  core_spacing_m: '1',
  density: '',
  greatest_slope_deg: '',
};

/** Without the digits that only come of counting in twos. */
export const numberText = (value: number | null): string =>
  value === null ? '' : String(Number(value.toPrecision(9)));

export const numberOrNull = (value: string): number | null => (value.trim() === '' ? null : Number(value));

export const definitionDraftOf = (survey: Schema<'SurveyDefinition'>): DefinitionDraft => ({
  zones: survey.zones,
  cell_m: numberText(survey.cell_m),
  core_spacing_m: numberText(survey.core_spacing_m),
  density: numberText(survey.density_t_per_m3),
  greatest_slope_deg: numberText(survey.greatest_slope_deg),
});

export const definitionOf = (draft: DefinitionDraft) => ({
  zones: [...draft.zones],
  cell_m: Number(draft.cell_m),
  core_spacing_m: Number(draft.core_spacing_m),
  density_t_per_m3: numberOrNull(draft.density),
  greatest_slope_deg: numberOrNull(draft.greatest_slope_deg),
});

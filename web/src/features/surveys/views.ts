// Loaded together, when the first of them is shown.

export { CompareNightsView } from './by_hand_view';
export { RunView } from './run_view';
export { NewScheduleView, ScheduleView } from './schedule_view';
export { SeriesView } from './series_view';
export { SurveyView } from './survey_view';
export { SurveysView } from './surveys_view';

// Loaded together, when the first of them is shown.

export { NewScheduleView, ScheduleView } from './schedule_view';
export { SeriesView } from './series_view';
export { SurveyView } from './survey_view';
export { SurveysView } from './surveys_view';

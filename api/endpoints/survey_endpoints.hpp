#pragma once

#include "api/answer.hpp"

namespace raywatch {
struct Call;
}

/// The handlers of surveys: see endpoints.hpp.
namespace raywatch::endpoints {

HttpAnswer create_schedule(Call& call);
HttpAnswer list_schedules(Call& call);
HttpAnswer get_schedule(Call& call);
HttpAnswer replace_schedule(Call& call);
HttpAnswer delete_schedule(Call& call);
HttpAnswer run_schedule(Call& call);
HttpAnswer list_schedule_runs(Call& call);

HttpAnswer create_epoch(Call& call);
HttpAnswer list_epochs(Call& call);
HttpAnswer get_epoch(Call& call);
HttpAnswer accept_epoch(Call& call);
HttpAnswer delete_epoch(Call& call);

HttpAnswer create_survey(Call& call);
HttpAnswer list_survey_runs(Call& call);
HttpAnswer get_survey_run(Call& call);
HttpAnswer cancel_survey_run(Call& call);
HttpAnswer get_survey_series(Call& call);
HttpAnswer list_surveys(Call& call);
HttpAnswer get_survey(Call& call);
HttpAnswer get_survey_volumes(Call& call);
HttpAnswer list_survey_changes(Call& call);
HttpAnswer get_survey_grid(Call& call);
HttpAnswer get_survey_difference_tiff(Call& call);
HttpAnswer get_survey_before_tiff(Call& call);
HttpAnswer get_survey_after_tiff(Call& call);
HttpAnswer get_survey_before_las(Call& call);
HttpAnswer get_survey_after_las(Call& call);
HttpAnswer get_survey_geojson(Call& call);
HttpAnswer get_survey_changes_csv(Call& call);
HttpAnswer get_survey_zones_csv(Call& call);
HttpAnswer get_survey_report(Call& call);
HttpAnswer get_survey_bundle(Call& call);

}  // namespace raywatch::endpoints

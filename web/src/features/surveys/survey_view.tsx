// One survey: its figures and how sure they are, the map, its changes, and what all of it rests on.

import './surveys.css';
import { navigate, useKeys, useResource } from '../../app/app';
import { linkTo } from '../../app/router';
import { address, type Schema } from '../../lib/api';
import { percent, squareMetres } from '../../lib/format';
import { SeverityBadge } from '../../ui/badges';
import { EmptyState, Loaded } from '../../ui/states';
import { Icon } from '../../ui/icon';
import { Ago, Time } from '../../ui/time';
import { LevelBadge } from './badges';
import { Card, NetCutFill } from './cards';
import { type Judged, surveyAt, useLevels, useVolumeZones, volumesAt } from './data';
import { Files } from './files';
import { RestsOn } from './rests_on';
import { SurveyChanges } from './survey_changes';
import { SurveyMap } from './survey_map';
import { ZoneFigures } from './zone_figures';
import { figureText, interval, kFigures, referenceOf, unitOf, worst } from './words';

type Survey = Schema<'SurveyDetail'>;

export function SurveyView({ id }: { id: string }) {
  const survey = useResource(surveyAt(Number(id)));
  return (
    <Loaded of={survey} what="survey">
      {(data) => <OneSurvey key={data.id} survey={data} />}
    </Loaded>
  );
}

function OneSurvey({ survey }: { survey: Survey }) {
  const { id, site } = survey;
  const volumes = useResource(volumesAt(id));
  const judged = useLevels([{ schedule: survey.schedule, thresholds: survey.ground.survey.thresholds }])(id);
  const level = worst(judged.map((each) => each.level));
  return (
    <>
      <div class="view-head">
        <h1>Survey {id}</h1>
        {level && <LevelBadge level={level} />}
        <span class="muted">
          {site}, <Time at={survey.before.captured_at} site={site} /> to{' '}
          <Time at={survey.after.captured_at} site={site} />
        </span>
        <span class="spacer" />
        <Neighbours survey={survey} />
        <a class="button primary" href={`/api/v1/surveys/${id}/report.html`} target="_blank">
          Report
        </a>
      </div>
      {survey.warnings.map((warning) => (
        <p key={warning} class="notice notice-busy survey-none">
          <Icon name="alert" /> <span>{warning}</span>
        </p>
      ))}
      <div class="survey">
        <Summary survey={survey} />
        <SurveyMap survey={survey} />
        <div class="survey-side">
          <Alarm survey={survey} judged={judged} />
          <Files survey={survey} />
        </div>
        <section class="panel panel-wide" aria-labelledby="figures">
          <header class="panel-head">
            <h2 id="figures">Figures</h2>
            <span class="muted">small: where the true value lies with 95 % certainty</span>
          </header>
          <Loaded of={volumes} what="figures">
            {({ zones, total }) => <ZoneFigures zones={zones} total={total} />}
          </Loaded>
        </section>
        <SurveyChanges survey={survey} />
        <RestsOn survey={survey} />
      </div>
    </>
  );
}

function Summary({ survey }: { survey: Survey }) {
  const { total } = survey;
  return (
    <dl class="panel panel-wide survey-cards">
      <NetCutFill total={total} reference={referenceOf(survey)} />
      <Card title="Changed area" under={`of ${squareMetres(total.seen_area_m2)} that were seen`}>
        {squareMetres(total.changed_area_m2)}
      </Card>
      <Card title="Seen in both epochs" under={`of ${squareMetres(total.area_m2)}`}>
        {percent(total.seen_share)}
      </Card>
      <Card
        title="The whole, with what was not seen"
        under={total.seen_share < 1 ? 'certain bounds, nothing interpolated' : 'all was seen'}
      >
        <span class="survey-bounds">{interval(total.whole.low_m3, total.whole.high_m3, 'm³', true)}</span>
      </Card>
    </dl>
  );
}

/** The surveys of the same schedule before and after this one. */
function Neighbours({ survey: { id, schedule } }: { survey: Survey }) {
  const items =
    useResource(
      schedule === null ? undefined : address('/api/v1/surveys', { query: { schedule, limit: 1000 } }),
    ).data?.items.map((each) => each.id) ?? [];
  const at = items.indexOf(id);
  const [later, earlier] = [items[at - 1], at < 0 ? undefined : items[at + 1]];
  const go = (to: number | undefined): void => {
    if (to !== undefined) navigate(`/surveys/${to}`);
  };
  useKeys([
    { key: 'k', does: 'the survey before', run: () => go(earlier) },
    { key: 'j', does: 'the next survey', run: () => go(later) },
  ]);
  if (schedule === null) return null;
  return (
    <>
      <button type="button" disabled={earlier === undefined} title="The survey before (k)" onClick={() => go(earlier)}>
        <Icon name="back" /> Before
      </button>
      <button type="button" disabled={later === undefined} title="The next survey (j)" onClick={() => go(later)}>
        Next <Icon name="next" />
      </button>
      <a class="button" href={linkTo('/surveys/series', { schedule })}>
        Series
      </a>
    </>
  );
}

/** Which figures have levels, what they came to, and the alerts that stood then. */
function Alarm({ survey, judged }: { survey: Survey; judged: readonly Judged[] }) {
  const zones = useVolumeZones(survey.site);
  const alerts =
    useResource(address('/api/v1/alerts', { query: { site: survey.site, limit: 1000 } })).data?.items ?? [];
  const standing = alerts.filter(
    ({ cause, opened_at, edited_at, state }) =>
      survey.schedule !== null &&
      cause === 'survey-level' &&
      Date.parse(opened_at) <= Date.parse(survey.made_at) + 1000 &&
      (state !== 'resolved' || Date.parse(edited_at) >= Date.parse(survey.made_at)),
  );
  return (
    <section class="panel survey-alarm" aria-labelledby="alarm">
      <header class="panel-head">
        <h2 id="alarm">Levels and alerts</h2>
      </header>
      {judged.length === 0 ? (
        <EmptyState title={survey.schedule === null ? 'By hand: no figure has levels.' : 'No figure has levels.'}>
          {survey.schedule !== null && <a href={`/surveys/schedules/${survey.schedule}`}>Give them in the schedule</a>}
        </EmptyState>
      ) : (
        <ul class="survey-levels">
          {judged.map(({ thresholds, value, level }) => (
            <li key={`${thresholds.figure} ${thresholds.zone}`}>
              <LevelBadge level={level} />
              <span>
                <b>
                  {kFigures[thresholds.figure]}, {zones.find(({ id }) => id === thresholds.zone)?.name ?? 'total'}
                </b>
                : {figureText(thresholds.figure, value)}
                <span class="survey-under">{levelWords(thresholds)}</span>
              </span>
            </li>
          ))}
        </ul>
      )}
      {standing.length > 0 && (
        <ul class="survey-levels">
          {standing.map((alert) => (
            <li key={alert.id}>
              <SeverityBadge severity={alert.severity} />
              <span>
                <a href={`/alerts/${alert.id}?state=all`}>{alert.title}</a>
                <span class="survey-under">
                  {alert.state}, opened <Ago at={alert.opened_at} site={alert.site} />
                </span>
              </span>
            </li>
          ))}
        </ul>
      )}
      {judged.length > 0 && standing.length === 0 && <p class="panel-body muted">No alert of a level stood then.</p>}
    </section>
  );
}

const levelWords = ({ figure, yellow, orange, red }: Judged['thresholds']): string =>
  `its size from ${[
    yellow !== null && `${yellow} yellow`,
    orange !== null && `${orange} orange`,
    red !== null && `${red} red`,
  ]
    .filter(Boolean)
    .join(', ')} (${unitOf(figure)})`;

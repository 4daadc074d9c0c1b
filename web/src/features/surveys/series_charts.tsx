// The charts of a schedule's figures; uPlot is loaded with them.

import { useResource } from '../../app/app';
import { address, type Schema } from '../../lib/api';
import { counted } from '../../lib/format';
import { SeriesChart } from '../../ui/series_chart';
import { EmptyPanel, Loaded } from '../../ui/states';
import { Time } from '../../ui/time';
import { type Run, type Schedule, seriesAt } from './data';
import { courseOf, limitsOf, rangeOf } from './series_data';
import { cubicMetres, type Figure, isMissed, kFigureNames, kFigures, kRunStates, unitOf } from './words';

type Series = Schema<'SurveySeries'>;

interface Asked {
  schedule: Schedule;
  zone: number | null;
  figure: Figure;
}

const kMostRuns = 1000;

export function SeriesCharts({ schedule, zone, figure, window_h }: Asked & { window_h: number }) {
  const series = useResource(seriesAt(schedule.id, figure, zone, window_h));
  const runs =
    useResource(address('/api/v1/schedules/{id}/runs', { path: { id: schedule.id }, query: { limit: kMostRuns } })).data
      ?.items ?? [];
  return (
    <Loaded of={series} what="series">
      {(data) =>
        data.values.length === 0 ? (
          <EmptyPanel title="No night has this figure yet.">
            <p>Each survey of {schedule.name} adds a value.</p>
          </EmptyPanel>
        ) : (
          <div class="panels">
            <Main schedule={schedule} zone={zone} figure={figure} series={data} runs={runs} />
            <Speed site={schedule.site} series={data} figure={figure} />
            {kFigureNames
              .filter((name) => name !== figure)
              .map((name) => (
                <section key={name} class="panel panel-body" aria-label={kFigures[name]}>
                  <Other schedule={schedule} zone={zone} figure={name} runs={runs} />
                </section>
              ))}
          </div>
        )
      }
    </Loaded>
  );
}

function Chart({ schedule, zone, figure, series, runs }: Asked & { series: Series; runs: readonly Run[] }) {
  const course = courseOf(series, runs);
  const limits = limitsOf(
    figure,
    schedule.survey.thresholds.find((each) => each.figure === figure && each.zone === zone),
  );
  const hasInterval = course.low.some((value) => value !== null);
  return (
    <SeriesChart
      label={kFigures[figure]}
      site={schedule.site}
      at_s={course.at_s}
      series={[{ values: course.values }]}
      unit={unitOf(figure)}
      range={rangeOf(course, limits)}
      band={hasInterval ? { name: '95 %', low: course.low, high: course.high } : undefined}
      limits={limits}
      gaps
    />
  );
}

function Main(props: Asked & { series: Series; runs: readonly Run[] }) {
  const { schedule, zone, figure, series, runs } = props;
  const since = series.values[0]?.at;
  const missed = runs.filter((run) => isMissed(run) && since !== undefined && run.due_at > since);
  const hasLevels = schedule.survey.thresholds.some((each) => each.figure === figure && each.zone === zone);
  return (
    <section class="panel panel-wide" aria-label={kFigures[figure]}>
      <div class="panel-body survey-series">
        <Chart {...props} />
        {!hasLevels && <p class="muted">This figure has no levels here: it raises no alert.</p>}
        <MissedNights runs={missed} site={schedule.site} />
      </div>
    </section>
  );
}

function MissedNights({ runs, site }: { runs: readonly Run[]; site: string }) {
  if (runs.length === 0) return <p class="muted">Every run since the first brought a result.</p>;
  return (
    <p class="survey-missed">
      <b>{counted(runs.length, 'gap')}:</b>{' '}
      {[...runs].reverse().map((run, index) => (
        <span key={run.id}>
          {index > 0 && '; '}
          <Time at={run.due_at} site={site} /> {kRunStates[run.state].words}
        </span>
      ))}
    </p>
  );
}

/** The sum of what changed, and how fast it changes. */
function Speed({ site, series, figure }: { site: string; series: Series; figure: Figure }) {
  const unit = unitOf(figure);
  if (unit === '%') return null;
  const at = (time: string): number => Date.parse(time) / 1000;
  const trend = series.values.map((value) => value.trend);
  const speeds = series.velocities.map(({ per_day }) => per_day);
  const [low, high] = [
    series.velocities.map(({ per_day, sigma_per_day }) => per_day - 1.96 * sigma_per_day),
    series.velocities.map(({ per_day, sigma_per_day }) => per_day + 1.96 * sigma_per_day),
  ];
  const inverse = series.velocities.map(({ inverse_days }) => inverse_days);
  const times = series.velocities.map((each) => at(each.at));
  const signed = (values: readonly (number | null)[]) => rangeOf({ values, low: [], high: [] }, []);
  return (
    <section class="panel panel-wide" aria-label="Velocity">
      <div class="panel-body survey-speeds">
        {series.cumulative && (
          <SeriesChart
            label={`${kFigures[figure]}, added up`}
            site={site}
            at_s={series.values.map((value) => at(value.at))}
            series={[{ values: trend }]}
            unit={unit}
            range={signed(trend)}
          />
        )}
        {speeds.length < 2 ? (
          <p class="muted">Velocities need more nights within their window.</p>
        ) : (
          <>
            <SeriesChart
              label="Velocity"
              site={site}
              at_s={times}
              series={[{ values: speeds }]}
              unit={`${unit}/day`}
              range={rangeOf({ values: speeds, low, high }, [])}
              band={{ name: '95 %', low, high }}
            />
            <SeriesChart
              label="Inverse velocity"
              site={site}
              at_s={times}
              series={[{ values: inverse }]}
              unit={`days/${unit}`}
              range={signed(inverse)}
            />
          </>
        )}
      </div>
      <Forecast series={series} site={site} />
    </section>
  );
}

function Forecast({ series: { forecast, values, figure, cumulative }, site }: { series: Series; site: string }) {
  const last = values.at(-1);
  return (
    <p class="panel-body survey-forecast muted">
      {cumulative && last && figure === 'net_m3' && <>Since the first night {cubicMetres(last.trend, true)}. </>}
      {forecast ? (
        <b>
          The inverse velocity falls to zero at <Time at={forecast.at} site={site} /> (from{' '}
          <Time at={forecast.earliest} site={site} />
          {forecast.latest === null ? ' on' : <> to {<Time at={forecast.latest} site={site} />}</>}; by{' '}
          {counted(forecast.values, 'value')}, r² {forecast.r_squared.toFixed(2)}).
        </b>
      ) : (
        'No forecast: the inverse velocity does not surely fall.'
      )}
    </p>
  );
}

/** Another figure, smaller. */
function Other({ schedule, zone, figure, runs }: Asked & { runs: readonly Run[] }) {
  const series = useResource(seriesAt(schedule.id, figure, zone));
  return (
    <Loaded of={series} what="series">
      {(data) => <Chart schedule={schedule} zone={zone} figure={figure} series={data} runs={runs} />}
    </Loaded>
  );
}

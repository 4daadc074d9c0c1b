// What the figures of a survey rest on: both epochs and their scans, how well these fit, the settings, and the log.

import { useState } from 'preact/hooks';
import { loader, showToast, useResource } from '../../app/app';
import { linkTo } from '../../app/router';
import { attempt } from '../../app/attempt';
import { withOperator } from '../../app/operator';
import { address, type Schema, send } from '../../lib/api';
import { count, degrees, metres, percent } from '../../lib/format';
import { StateBadge } from '../../ui/badges';
import { ConfirmDialog } from '../../ui/confirm_dialog';
import { Time } from '../../ui/time';
import { RunLog } from './run_log';
import { referenceInWords, referenceOf } from './words';

type Survey = Schema<'SurveyDetail'>;
type Scan = Schema<'SurveyedScan'>;

const epochAt = (id: number) => address('/api/v1/epochs/{id}', { path: { id } });

export function RestsOn({ survey }: { survey: Survey }) {
  return (
    <>
      <section class="panel panel-wide" aria-labelledby="rests-on">
        <header class="panel-head">
          <h2 id="rests-on">What it rests on</h2>
        </header>
        <div class="panel-body survey-rests">
          <EpochOf survey={survey} side="before" />
          <EpochOf survey={survey} side="after" />
          <Settings survey={survey} />
        </div>
      </section>
      <Log survey={survey} />
    </>
  );
}

function EpochOf({ survey, side }: { survey: Survey; side: 'before' | 'after' }) {
  const { site, ground } = survey;
  const epoch = useResource(epochAt(survey[side].epoch)).data;
  const [asking, setAsking] = useState(false);
  return (
    <section>
      <div class="actions">
        <h3>
          {side === 'before' ? 'Before' : 'After'}: epoch {survey[side].epoch}
        </h3>
        {epoch?.state === 'accepted' && <StateBadge tone="good">accepted</StateBadge>}
        {epoch?.state === 'refused' && <StateBadge tone="bad">refused</StateBadge>}
        <span class="muted">
          {percent(ground.testable[side], 1)} of its points can be judged by the other epoch
          {epoch?.accepted && `; accepted by ${epoch.accepted.by}`}
        </span>
        <span class="spacer" />
        {side === 'after' && epoch?.state === 'usable' && (
          <button type="button" onClick={() => setAsking(true)}>
            Accept this state …
          </button>
        )}
      </div>
      <ScanTable site={site} scans={ground.scans[side]} caption={`scans of epoch ${survey[side].epoch}`} />
      {asking && epoch && <AcceptDialog epoch={epoch.id} onClose={() => setAsking(false)} />}
    </section>
  );
}

function ScanTable({ site, scans, caption }: { site: string; scans: readonly Scan[]; caption: string }) {
  const millimetres = (value: number | null): string => (value === null ? '–' : `${(1000 * value).toFixed(1)}\u00a0mm`);
  return (
    <div class="table-scroll" tabIndex={0} role="region" aria-label={caption}>
      <table>
        <caption class="visually-hidden">{caption}</caption>
        <thead>
          <tr>
            <th scope="col">Scan</th>
            <th scope="col">Taken</th>
            <th scope="col" class="numeric">
              Vantage
            </th>
            <th scope="col" class="numeric">
              Points
            </th>
            <th scope="col">Registration</th>
            <th scope="col" class="numeric">
              Residual
            </th>
            <th scope="col" class="numeric">
              Uncertain by (1σ)
            </th>
            <th scope="col">SHA-256</th>
          </tr>
        </thead>
        <tbody>
          {scans.map(({ scan, captured_at, vantage, points, registration, sha256 }) => (
            <tr key={scan}>
              <td>
                <a href={`/scans/${scan}`}>{scan}</a>
              </td>
              <td>
                <Time at={captured_at} site={site} />
              </td>
              <td class="numeric">{vantage}</td>
              <td class="numeric">{count(points)}</td>
              <td>
                <StateBadge
                  tone={registration.state === 'good' ? 'good' : registration.state === 'none' ? 'plain' : 'bad'}
                >
                  {registration.state === 'none' ? 'as reported' : registration.state}
                </StateBadge>
              </td>
              <td class="numeric">{millimetres(registration.residual_m)}</td>
              <td class="numeric">
                {millimetres(registration.position_sigma_m)}, {degrees(registration.angle_sigma_deg, 4)}
              </td>
              <td>
                <code title={sha256}>{sha256.slice(0, 12)}…</code>
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function Settings({ survey: whole }: { survey: Survey }) {
  const { id, ground, made_at, site } = whole;
  const { survey } = ground;
  const facts: readonly (readonly [string, string])[] = [
    ['Compared with', referenceInWords(referenceOf(whole))],
    ['Cells of the models', metres(survey.cell_m)],
    ['Core points of M3C2', `${metres(survey.core_spacing_m)} apart`],
    ['Registration error', `${metres(ground.registration_m, 3)} (M3C2)`],
    ['Density in place', survey.density_t_per_m3 === null ? 'not given' : `${survey.density_t_per_m3}\u00a0t/m³`],
    ['Steepest ground', survey.greatest_slope_deg === null ? 'not assumed' : degrees(survey.greatest_slope_deg, 0)],
    [
      'Refused beyond',
      `${metres(survey.tolerance.residual_m, 3)} residual, ${metres(survey.tolerance.position_m, 3)}, ${degrees(survey.tolerance.angle_deg, 3)}`,
    ],
    ['Made by', `raywatch ${ground.program_version}`],
  ];
  return (
    <section>
      <div class="actions">
        <h3>Settings</h3>
        <span class="spacer" />
        <a href={linkTo('/surveys/compare', { site, like: id })}>Compare these two otherwise</a>
      </div>
      <dl class="figures">
        {facts.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
        <div>
          <dt>Made at</dt>
          <dd>
            <Time at={made_at} site={site} />
          </dd>
        </div>
      </dl>
    </section>
  );
}

function Log({ survey }: { survey: Survey }) {
  const run = useResource(address('/api/v1/surveys/runs/{id}', { path: { id: survey.run } })).data;
  return run ? <RunLog run={run} /> : null;
}

/** Schedules that compare with what is accepted compare with the latest accepted epoch. */
function AcceptDialog({ epoch, onClose }: { epoch: number; onClose: () => void }) {
  const accept = (by: string, note: string): Promise<boolean> =>
    attempt(async () => {
      const answer = await send('post', '/api/v1/epochs/{id}/accept', { path: { id: epoch }, body: { by, note } });
      loader.put(epochAt(epoch), { data: answer.data, etag: undefined });
      loader.invalidate((key) => key.startsWith('/api/v1/epochs'));
      showToast('good', `Epoch ${epoch} is accepted.`);
    });
  return (
    <ConfirmDialog
      title={`Accept epoch ${epoch}?`}
      draft=""
      about="the epoch"
      words="Schedules that compare with the latest accepted state compare with this one from now on. Its scans are kept."
      doIt="Accept it"
      onClose={onClose}
      onConfirm={(note) => {
        onClose();
        withOperator((by) => void accept(by, note));
      }}
    />
  );
}

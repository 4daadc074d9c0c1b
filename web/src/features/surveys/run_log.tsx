import { Time } from '../../ui/time';
import { type Run } from './data';

/** What a run did and found, step by step. */
export function RunLog({ run: { id, site, log } }: { run: Run }) {
  return (
    <section class="panel panel-wide survey-log" aria-labelledby="log">
      <header class="panel-head">
        <h2 id="log">Log of its run</h2>
        <span class="muted">run {id}</span>
      </header>
      <ol class="panel-body">
        {log.map(({ at, text }, index) => (
          <li key={index}>
            <span class="muted">
              <Time at={at} site={site} />
            </span>
            <span>{text}</span>
          </li>
        ))}
      </ol>
    </section>
  );
}

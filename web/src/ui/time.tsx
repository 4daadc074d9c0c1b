import { useSelect } from '../app/app';
import { useZone } from '../app/sites';
import { ago, dateTime, shortTime } from '../lib/format';

interface TimeProps {
  at: string;
  site: string | undefined;
}

/** A moment in its site's zone, which is named; the pointer shows it whole. */
export function Time({ at, site, whole = false }: TimeProps & { whole?: boolean }) {
  const zone = useZone(site);
  const now_ms = useSelect((state) => state.now_ms);
  return (
    <time dateTime={at} title={`${dateTime(at, zone)} (${zone}); ${at}`}>
      {whole ? dateTime(at, zone) : shortTime(at, zone, now_ms)}
    </time>
  );
}

/** How long ago; the pointer shows when. */
export function Ago({ at, site }: TimeProps) {
  const zone = useZone(site);
  const now_ms = useSelect((state) => state.now_ms);
  return (
    <time dateTime={at} title={`${dateTime(at, zone)} (${zone})`}>
      {ago(at, now_ms)}
    </time>
  );
}

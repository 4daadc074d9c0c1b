import { useSites } from '../app/sites';

/** Which site a view is about; nothing to choose where there is one. */
export function SitePicker({ site, onSite }: { site: string; onSite: (site: string) => void }) {
  const sites = useSites();
  if (sites.length < 2) return null;
  return (
    <select aria-label="Site" value={site} onChange={(event) => onSite(event.currentTarget.value)}>
      {sites.map(({ name }) => (
        <option key={name} value={name}>
          {name}
        </option>
      ))}
    </select>
  );
}

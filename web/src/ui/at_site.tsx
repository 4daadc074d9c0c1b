// Views about one site, and those on which something new of a site is made.

import { type ComponentChildren } from 'preact';
import { setQuery } from '../app/app';
import { SitePicker } from './site_picker';
import { EmptyPanel } from './states';

/** What there is of a site; says so where there is none. */
export function AtSite({
  site,
  children,
}: {
  site: string | undefined;
  children: (site: string) => ComponentChildren;
}) {
  if (site !== undefined) return <>{children(site)}</>;
  return (
    <EmptyPanel title="There is no site yet.">
      <FirstScan of="A site" />
    </EmptyPanel>
  );
}

/** How what is not there yet comes to be. */
export const FirstScan = ({ of }: { of: string }) => (
  <p>
    {of} is made with its first scan: <code>raywatch ingest scans/*.pcd --site yard --sensor mast --create</code>
  </p>
);

/** The view on which something new is made; its site stands in the link. */
export function NewAtSite({
  title,
  words = 'at',
  site,
  children,
}: {
  title: string;
  /** What stands before the site. */
  words?: string;
  site: string | undefined;
  children: (site: string) => ComponentChildren;
}) {
  return (
    <>
      <div class="view-head">
        <h1>{title}</h1>
        {site !== undefined && (
          <>
            <span class="muted">
              {words} {site}
            </span>
            <SitePicker site={site} onSite={(name) => setQuery({ site: name }, { replace: true })} />
          </>
        )}
      </div>
      <AtSite key={site} site={site}>
        {children}
      </AtSite>
    </>
  );
}

import { useState } from 'preact/hooks';
import { loader, navigate, useResource } from '../../app/app';
import { useZone } from '../../app/sites';
import { address, send } from '../../lib/api';
import { EditForm, type PartProps, useEditing } from '../../ui/edit_form';
import { ParameterFields } from './parameter_fields';
import { scansIn } from './parameters';
import { ReferenceFields } from './reference_fields';
import { type Draft, requestFrom } from './request';
import { ScanField } from './scan_field';

export type ComparePart = PartProps<Draft>;

/** The scan that is named; nothing while it is no number. Wrong numbers are said by the daemon when it is asked to compare. */
function useNamedScan(text: string) {
  const [id] = scansIn(text) ?? [];
  return useResource(id === undefined ? undefined : address('/api/v1/scans/{id}', { path: { id } }));
}

export function CompareForm({ initial }: { initial: Draft }) {
  const { draft, run, form } = useEditing(initial);
  const [asked, setAsked] = useState(initial.scan);
  const scan = useNamedScan(asked);
  const zone = useZone(scan.data?.site);
  const { request, errors } = requestFrom(draft, zone);
  const compare = (): void =>
    void run(async () => {
      const { data } = await send('post', '/api/v1/comparisons', { body: request });
      loader.invalidate((key) => key.startsWith('/api/v1/comparisons?') || key === `/api/v1/scans/${data.scan}`);
      navigate(`/comparisons/${data.id}`);
    });
  return (
    <EditForm
      {...form}
      class="compare"
      words={form.saving ? 'Sending …' : 'Compare'}
      faults={Object.fromEntries(errors)}
      onSave={compare}
      actions={<span class="muted">It runs as a job; nothing that is stored is changed by it.</span>}
    >
      {(part) => (
        <div class="panels">
          <section class="panel" aria-labelledby="which">
            <header class="panel-head">
              <h2 id="which">Which scan</h2>
            </header>
            <ScanField
              {...part}
              scan={scan}
              onAsk={() => setAsked(draft.scan)}
              onPick={(id) => {
                part.set({ scan: id });
                setAsked(id);
              }}
            />
          </section>
          <section class="panel" aria-labelledby="with">
            <header class="panel-head">
              <h2 id="with">With what</h2>
            </header>
            <ReferenceFields {...part} site={scan.data?.site} zone={zone} />
          </section>
          <section class="panel panel-wide" aria-labelledby="how">
            <header class="panel-head">
              <h2 id="how">How</h2>
              <span class="muted">what is left empty is as the profile of the site has it</span>
            </header>
            <ParameterFields {...part} site={scan.data?.site} />
          </section>
        </div>
      )}
    </EditForm>
  );
}

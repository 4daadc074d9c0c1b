import { useEffect, useRef, useState } from 'preact/hooks';
import { loader, navigate, useResource } from '../../app/app';
import { useZone } from '../../app/sites';
import { address, send } from '../../lib/api';
import { Problem } from '../../lib/problem';
import { ParameterFields } from './parameter_fields';
import { ReferenceFields } from './reference_fields';
import { type Draft, type FieldErrors, requestFrom } from './request';
import { ScanField } from './scan_field';
import { scansIn } from './parameters';

/** What is wrong with a field of the form, in its place. */
export function FieldError({ message }: { message: string | undefined }) {
  return message === undefined ? null : <span class="field-bad">{message}</span>;
}

export interface PartProps {
  readonly draft: Draft;
  readonly errors: FieldErrors;
  readonly onChange: (change: Partial<Draft>) => void;
}

const kNoErrors: FieldErrors = new Map();

/** The scan that is named; nothing while it is no number. Wrong numbers are said by the daemon when it is asked to compare. */
function useNamedScan(text: string) {
  const [id] = scansIn(text) ?? [];
  return useResource(id === undefined ? undefined : address('/api/v1/scans/{id}', { path: { id } }));
}

export function CompareForm({ initial }: { initial: Draft }) {
  const [draft, setDraft] = useState(initial);
  const [asked, setAsked] = useState(initial.scan);
  const [errors, setErrors] = useState(kNoErrors);
  const [problem, setProblem] = useState<Problem | undefined>();
  const [sending, setSending] = useState(false);
  const form = useRef<HTMLFormElement>(null);
  const scan = useNamedScan(asked);
  const zone = useZone(scan.data?.site);
  useEffect(() => {
    if (errors.size > 0) form.current?.querySelector<HTMLElement>('[aria-invalid="true"]')?.focus();
  }, [errors]);

  const submit = async (): Promise<void> => {
    const { request, errors: wrong } = requestFrom(draft, zone);
    setErrors(wrong);
    setProblem(undefined);
    if (wrong.size > 0) return;
    setSending(true);
    try {
      const { data } = await send('post', '/api/v1/comparisons', { body: request });
      loader.invalidate((key) => key.startsWith('/api/v1/comparisons?') || key === `/api/v1/scans/${data.scan}`);
      navigate(`/comparisons/${data.id}`);
    } catch (failure) {
      if (!(failure instanceof Problem)) throw failure;
      setErrors(new Map(failure.fields.map(({ field, message }) => [field, message])));
      setProblem(failure);
      setSending(false);
    }
  };
  const part: PartProps = { draft, errors, onChange: (change) => setDraft({ ...draft, ...change }) };
  return (
    <form
      ref={form}
      class="compare"
      noValidate
      onSubmit={(event) => {
        event.preventDefault();
        void submit();
      }}
    >
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
              setDraft({ ...draft, scan: id });
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
      {problem && (
        <p class="panel panel-body field-bad" role="alert">
          {problem.title}. {problem.message}
        </p>
      )}
      <div class="actions compare-actions">
        <button type="submit" class="primary" disabled={sending}>
          {sending ? 'Sending …' : 'Compare'}
        </button>
        <span class="muted">It runs as a job; nothing that is stored is changed by it.</span>
      </div>
    </form>
  );
}

// A zone drawn and filled in: on the picture, from the side, and in numbers. All three show the same draft.

import { type ComponentChildren } from 'preact';
import { useMemo, useReducer, useRef, useState } from 'preact/hooks';
import { useResource } from '../../app/app';
import { address, type Schema } from '../../lib/api';
import { counted, metres, squareMetres } from '../../lib/format';
import { type Problem } from '../../lib/problem';
import { EditForm, type PartProps } from '../../ui/edit_form';
import { NumberField, SelectField, TextField } from '../../ui/form';
import { type Bounds, boundsOf, widened } from '../../ui/top_view/frame';
import { type Overlay } from '../../ui/top_view/overlays';
import { type Scene, useScene } from '../../ui/top_view/scene';
import { type PickedPlace, TopView } from '../../ui/top_view/top_view';
import { CornerTable } from './corner_table';
import { bodyOf, faultsOf, type ZoneDraft } from './draft';
import { OutlineTool, placed, pressed } from './drawing';
import { pointsBetween, pointsOver } from './inside';
import { beginOutline, type OutlineEdit, reduceOutline } from './outline_edit';
import { asOverlay } from './overlays';
import { area, perimeter } from './polygon';
import { SideView } from './side_view';
import { kZoneKinds, meaningOf } from './zone_kinds';

export interface ZoneEditorProps {
  site: string;
  /** The zone that is edited; nothing for a new one. */
  id?: number;
  initial: ZoneDraft;
  corners?: readonly (readonly [number, number])[];
  problem: Problem | undefined;
  saving: boolean;
  /** Under the fields: beside "Save". */
  actions?: ComponentChildren;
  /** Above the fields; gets what is filled in. */
  notice?: (mine: Schema<'ZoneEdit'>) => ComponentChildren;
  onSave: (body: Schema<'ZoneEdit'>) => void;
}

/** A new zone begins so far below and above the ground at its first corner. */
const kBelow_m = 0.5;
const kAbove_m = 2.5;

export function ZoneEditor(props: ZoneEditorProps) {
  const scene = useScene(props.site);
  const [draft, setDraft] = useState(props.initial);
  const [outline, dispatch] = useReducer(reduceOutline, props.corners, beginOutline);
  const current = useRef(outline);
  current.current = outline;
  const [tool] = useState(() => new OutlineTool(() => current.current, dispatch));
  const [focus_m] = useState(() => focusOn(outline));
  const others = useOthers(props.site, props.id);
  const inside = useMemo(() => pointsOver(scene.clouds, outline.corners), [scene.clouds, outline.corners]);
  const heights = [Number(draft.z_min_m || NaN), Number(draft.z_max_m || NaN)] as const;
  const between = useMemo(
    () => inside && pointsBetween(scene.clouds, inside, heights),
    [scene.clouds, inside, heights[0], heights[1]],
  );
  const overlays = useMemo((): Overlay[] => {
    const { corners, closed, held } = outline;
    const own = { corners_m: corners, closed, handles: { held }, chosen: true } as const;
    return [...others.map((zone) => asOverlay(zone)), { kind: 'outline', tone: 'accent', ...own }];
  }, [others, outline]);
  const pick = (picked: PickedPlace): void => {
    if (outline.corners.length === 0) setDraft(withGround(draft, picked));
    placed(current.current, picked, dispatch);
  };
  const faults = faultsOf(draft, outline);
  return (
    <div class="zone-editor">
      <div class="zone-picture">
        <TopView
          scene={scene}
          label={`${props.site} from above, to draw the zone on`}
          overlays={overlays}
          focus_m={focus_m}
          marks={between?.marks}
          tool={tool}
          onPick={pick}
          onKey={(event) => pressed(current.current, event, dispatch)}
        />
        <DrawingBar edit={outline} dispatch={dispatch} />
        {inside && between && (
          <SideView
            inside={inside}
            count={between.count}
            z_min_m={heights[0]}
            z_max_m={heights[1]}
            onHeights={({ z_min_m, z_max_m }) =>
              setDraft({ ...draft, z_min_m: String(z_min_m), z_max_m: String(z_max_m) })
            }
          />
        )}
      </div>
      <EditForm
        draft={draft}
        onDraft={setDraft}
        problem={props.problem}
        saving={props.saving}
        faults={faults}
        notice={props.notice?.(bodyOf(draft, outline))}
        actions={props.actions}
        onSave={() => props.onSave(bodyOf(draft, outline))}
      >
        {(part) => (
          <>
            <ZoneFields {...part} />
            <OutlineFields
              scene={scene}
              edit={outline}
              dispatch={dispatch}
              error={part.error('polygon_m') ?? (outline.closed ? faults.polygon_m : undefined)}
            />
          </>
        )}
      </EditForm>
    </div>
  );
}

function focusOn({ corners }: OutlineEdit): Bounds | undefined {
  const bounds = boundsOf(corners);
  if (!bounds) return undefined;
  const widest_m = Math.max(bounds.max[0] - bounds.min[0], bounds.max[1] - bounds.min[1]);
  return widened(bounds, Math.max(2, widest_m * 0.6));
}

function useOthers(site: string, id: number | undefined): readonly Schema<'Zone'>[] {
  const page = useResource(address('/api/v1/zones', { query: { site, limit: 200 } })).data;
  return useMemo(() => (page?.items ?? []).filter((zone) => zone.id !== id), [page, id]);
}

/** Heights around the ground where the outline begins, as long as none are filled in. */
function withGround(draft: ZoneDraft, { ground_m }: PickedPlace): ZoneDraft {
  if (ground_m === undefined || draft.z_min_m !== '' || draft.z_max_m !== '') return draft;
  return { ...draft, z_min_m: (ground_m - kBelow_m).toFixed(2), z_max_m: (ground_m + kAbove_m).toFixed(2) };
}

function DrawingBar({
  edit,
  dispatch,
}: {
  edit: OutlineEdit;
  dispatch: (action: Parameters<typeof reduceOutline>[1]) => void;
}) {
  const words = edit.closed
    ? 'Drag a corner to move it, or a small dot between two to add one. Drag beside them to move the picture.'
    : edit.corners.length === 0
      ? 'Click on the picture where the first corner is.'
      : edit.corners.length < 3
        ? 'Click where the next corner is.'
        : 'Click where the next corner is, or on the first one to close the outline.';
  return (
    <div class="drawing-bar">
      <p class="muted">{words}</p>
      <div class="actions">
        {!edit.closed && (
          <button type="button" disabled={edit.corners.length < 3} onClick={() => dispatch({ type: 'closed' })}>
            Close it
          </button>
        )}
        <button type="button" disabled={edit.past.length === 0} onClick={() => dispatch({ type: 'undone' })}>
          Undo
        </button>
        <button type="button" disabled={edit.future.length === 0} onClick={() => dispatch({ type: 'redone' })}>
          Redo
        </button>
        <button type="button" disabled={edit.corners.length === 0} onClick={() => dispatch({ type: 'cleared' })}>
          Draw anew
        </button>
      </div>
    </div>
  );
}

function ZoneFields({ draft, field }: PartProps<ZoneDraft>) {
  return (
    <>
      <TextField label="Name" {...field('name')} />
      <SelectField
        label="Kind"
        hint={meaningOf(draft.kind)}
        options={kZoneKinds.map(({ kind }) => ({ value: kind, words: kind }))}
        {...field('kind')}
      />
      <div class="field-pair">
        <NumberField label="From height" unit="m" {...field('z_min_m')} />
        <NumberField label="To height" unit="m" {...field('z_max_m')} />
      </div>
    </>
  );
}

function OutlineFields({
  scene,
  edit,
  dispatch,
  error,
}: {
  scene: Scene;
  edit: OutlineEdit;
  dispatch: (action: Parameters<typeof reduceOutline>[1]) => void;
  error: string | undefined;
}) {
  const { corners } = edit;
  const ground = corners.length > 0 ? scene.ground?.at(corners[0]!) : undefined;
  const middle = (): readonly [number, number] => {
    const extent = scene.extent_m;
    return (
      corners.at(-1) ??
      (extent
        ? [Math.round((extent.min[0] + extent.max[0]) / 2), Math.round((extent.min[1] + extent.max[1]) / 2)]
        : [0, 0])
    );
  };
  return (
    <fieldset class="outline-fields">
      <legend>Outline</legend>
      <p class="muted">
        {counted(corners.length, 'corner')}
        {corners.length >= 3 && `, ${squareMetres(area(corners))}, ${metres(perimeter(corners), 1)} around`}
        {ground && `; ground at ${metres(ground.ground_m)}`}
      </p>
      {error && (
        <p class="field-bad" role="alert">
          The outline {error}.
        </p>
      )}
      <CornerTable edit={edit} dispatch={dispatch} />
      {!edit.closed && (
        <div class="actions">
          <button type="button" onClick={() => dispatch({ type: 'added', at: middle() })}>
            Add a corner
          </button>
        </div>
      )}
      <details>
        <summary>Drawing by keys</summary>
        <p class="muted">
          With the picture in focus: arrow keys move it under the cross, <kbd>Enter</kbd> sets a corner there,{' '}
          <kbd>c</kbd> closes the outline, <kbd>[</kbd> and <kbd>]</kbd> choose a corner, <kbd>Ctrl</kbd> with arrow
          keys moves it by 0.1&nbsp;m, <kbd>Delete</kbd> takes it away, <kbd>Ctrl</kbd>+<kbd>Z</kbd> takes back.
        </p>
      </details>
    </fieldset>
  );
}

// The whole state of the dashboard: one immutable object of slices, each with a pure reducer in a module of its own.
// A feature that needs state adds its slice here; what only one component needs stays in that component.

import { type LiveState } from '../lib/event_stream';
import { reduceResources, type ResourceAction, type Resources } from '../lib/resources';
import { reduceTriage, type Triage, type TriageAction, noTriage } from '../features/alerts/triage';
import { reduceUploads, type Upload, type UploadAction } from '../features/scans/uploads';
import { type Location, type RouterAction, reduceLocation } from './router';
import { reduceSettings, type Settings, type SettingsAction } from './settings';
import { reduceToasts, type Toast, type ToastAction } from './toasts';

export interface State {
  readonly location: Location;
  readonly live: LiveState;
  readonly now_ms: number;
  readonly resources: Resources;
  readonly settings: Settings;
  readonly toasts: readonly Toast[];
  readonly triage: Triage;
  readonly uploads: readonly Upload[];
}

export type Action =
  | { type: 'live/changed'; live: LiveState }
  | { type: 'clock/ticked'; now_ms: number }
  | RouterAction
  | ResourceAction
  | SettingsAction
  | ToastAction
  | TriageAction
  | UploadAction;

export function initialState(location: Location, settings: Settings, now_ms: number): State {
  return {
    location,
    live: { state: 'connecting' },
    now_ms,
    resources: {},
    settings,
    toasts: [],
    triage: noTriage,
    uploads: [],
  };
}

export function reduce(state: State, action: Action): State {
  const next: State = {
    location: isFor<RouterAction>('location/', action) ? reduceLocation(state.location, action) : state.location,
    live: action.type === 'live/changed' ? action.live : state.live,
    now_ms: action.type === 'clock/ticked' ? action.now_ms : state.now_ms,
    resources: isFor<ResourceAction>('resource/', action) ? reduceResources(state.resources, action) : state.resources,
    settings: isFor<SettingsAction>('settings/', action) ? reduceSettings(state.settings, action) : state.settings,
    toasts: isFor<ToastAction>('toast/', action) ? reduceToasts(state.toasts, action) : state.toasts,
    triage: isFor<TriageAction>('triage/', action) ? reduceTriage(state.triage, action) : state.triage,
    uploads: isFor<UploadAction>('upload/', action) ? reduceUploads(state.uploads, action) : state.uploads,
  };
  return (Object.keys(next) as (keyof State)[]).every((slice) => next[slice] === state[slice]) ? state : next;
}

function isFor<A extends Action>(prefix: string, action: Action): action is A & Action {
  return action.type.startsWith(prefix);
}

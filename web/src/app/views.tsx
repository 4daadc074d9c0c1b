// The table of views. To add a page: a component in src/features/NAME/, and one line here. A view that is heavy, or
// rarely opened, is loaded when it is first shown: `lazy(() => import(...))`. Where the link goes to another line with the
// same component, that component stays and gets other properties.

import { type ComponentType } from 'preact';
import { AlertsView } from '../features/alerts/alerts_view';
import { BaselinesView } from '../features/baselines/baselines_view';
import { ChangeView } from '../features/changes/change_view';
import { ComparisonSceneView, ScanSceneView } from '../features/changes/scan_scene_view';
import { OverviewView } from '../features/overview/overview_view';
import { ScanView } from '../features/scans/scan_view';
import { ScansView } from '../features/scans/scans_view';
import { SensorView } from '../features/sensors/sensor_view';
import { SensorsView } from '../features/sensors/sensors_view';
import { SilencesView } from '../features/silences/silences_view';
import { type IconName } from '../ui/icon';
import { lazy } from './lazy';
import { matchPath } from './router';

/** What the placeholders of the view's pattern stand for: `/alerts/:id` gives `{id}`. */
export type ViewProps = Readonly<Record<string, string>>;

export interface View {
  readonly pattern: string;
  readonly title: string;
  readonly component: ComponentType<ViewProps>;
  /** Views without it are reached from others. */
  readonly menu?: { readonly icon: IconName };
}

const view = (pattern: string, title: string, component: ComponentType<never>, menu?: View['menu']): View => ({
  pattern,
  title,
  component: component as ComponentType<ViewProps>,
  ...(menu ? { menu } : {}),
});

/** A view of a module that is loaded when the first of its views is shown. */
function loaded<Module>(load: () => Promise<Module>): (name: keyof Module) => ComponentType<never> {
  return (name) =>
    lazy<ViewProps>(async () => (await load())[name] as ComponentType<ViewProps>) as ComponentType<never>;
}

const history = loaded(() => import('../features/history/history_view'));
const tracks = loaded(() => import('../features/tracks/views'));
const comparisons = loaded(() => import('../features/comparisons/views'));
const zones = loaded(() => import('../features/zones/views'));
const channels = loaded(() => import('../features/channels/views'));
const rules = loaded(() => import('../features/rules/views'));
const surveys = loaded(() => import('../features/surveys/views'));
const sites = loaded(() => import('../features/sites/site_view'));
const storage = loaded(() => import('../features/storage/storage_view'));

export const kViews: readonly View[] = [
  view('/', 'Overview', OverviewView, { icon: 'overview' }),
  view('/alerts', 'Alerts', AlertsView, { icon: 'alert' }),
  view('/alerts/:id', 'Alert', AlertsView),
  view('/history', 'History', history('HistoryView'), { icon: 'history' }),
  view('/tracks', 'Tracks', tracks('TracksView'), { icon: 'change' }),
  view('/tracks/:id', 'Track', tracks('TrackView')),
  view('/scans', 'Scans', ScansView, { icon: 'scan' }),
  view('/scans/:id', 'Scan', ScanView),
  view('/scans/:id/3d', 'Scan in 3D', ScanSceneView),
  view('/changes/:id', 'Change', ChangeView),
  view('/comparisons', 'Comparisons', comparisons('ComparisonsView'), { icon: 'compare' }),
  view('/comparisons/:id', 'Comparison', comparisons('ComparisonView')),
  view('/comparisons/:id/3d', 'Comparison in 3D', ComparisonSceneView),
  view('/compare', 'Compare by hand', comparisons('CompareView')),
  view('/sensors', 'Sensors', SensorsView, { icon: 'sensor' }),
  view('/sensors/:name', 'Sensor', SensorView),
  view('/sites/:name', 'Site', sites('SiteView')),
  view('/surveys', 'Surveys', surveys('SurveysView'), { icon: 'survey' }),
  view('/surveys/series', 'Series of surveys', surveys('SeriesView')),
  view('/surveys/compare', 'Compare two nights', surveys('CompareNightsView')),
  view('/surveys/runs/:id', 'Run of a survey', surveys('RunView')),
  view('/surveys/:id', 'Survey', surveys('SurveyView')),
  view('/surveys/schedules/new', 'New schedule', surveys('NewScheduleView')),
  view('/surveys/schedules/:id', 'Schedule', surveys('ScheduleView')),
  view('/baselines', 'Baselines', BaselinesView, { icon: 'baseline' }),
  view('/silences', 'Silences', SilencesView, { icon: 'silence' }),
  view('/zones', 'Zones', zones('ZonesView'), { icon: 'zone' }),
  view('/zones/new', 'New zone', zones('NewZoneView')),
  view('/zones/:id', 'Zone', zones('ZoneView')),
  view('/rules', 'Rules', rules('RulesView'), { icon: 'rule' }),
  view('/rules/new', 'New rule', rules('NewRuleView')),
  view('/rules/:id', 'Rule', rules('RuleView')),
  view('/channels', 'Channels', channels('ChannelsView'), { icon: 'channel' }),
  view('/channels/new', 'New channel', channels('NewChannelView')),
  view('/channels/:id', 'Channel', channels('ChannelView')),
  view('/deliveries', 'Deliveries', channels('DeliveriesView'), { icon: 'delivery' }),
  view('/storage', 'Storage', storage('StorageView'), { icon: 'storage' }),
];

/** The view that a path shows, with what its placeholders stand for. */
export function viewAt(path: string): { view: View | undefined; values: Record<string, string> } {
  for (const view of kViews) {
    const values = matchPath(view.pattern, path);
    if (values) return { view, values };
  }
  return { view: undefined, values: {} };
}

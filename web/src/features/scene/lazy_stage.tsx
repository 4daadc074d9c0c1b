import { lazy } from '../../app/lazy';

/** The 3D view, whose code comes when it is first shown. */
export const LazyStage = lazy(() => import('./scene_stage').then(({ SceneStage }) => SceneStage));

// The life of a viewer in a canvas: made when the canvas is there, told of its size, ended with it.

import { type RefObject } from 'preact';
import { useEffect, useState } from 'preact/hooks';
import { type Vector3 } from '../../lib/points/quantised';
import { type Camera } from './camera';
import { control } from './controls';
import { readPalette } from './palette';
import { Viewer } from './viewer';

export type ViewerState =
  { state: 'starting' } | { state: 'ready'; viewer: Viewer } | { state: 'missing' } | { state: 'lost' };

export interface ViewerSetting {
  readonly anchor_m: Vector3;
  readonly radius_m: number;
  readonly camera: Camera;
}

export function useViewer(
  stage: RefObject<HTMLElement>,
  canvas: RefObject<HTMLCanvasElement>,
  setting: ViewerSetting,
  onClick: RefObject<(at: { x: number; y: number }) => void>,
): ViewerState {
  const [state, setState] = useState<ViewerState>({ state: 'starting' });
  useEffect(() => {
    const [element, screen] = [stage.current, canvas.current];
    if (!element || !screen) return;
    const context = screen.getContext('webgl2', {
      alpha: false,
      antialias: false,
      powerPreference: 'high-performance',
    });
    if (!context) return setState({ state: 'missing' });
    const palette = readPalette();
    const viewer = new Viewer({ canvas: screen, context, palette, ...setting });
    const sizes = new ResizeObserver(() => viewer.resize({ width: element.clientWidth, height: element.clientHeight }));
    viewer.resize({ width: element.clientWidth, height: element.clientHeight });
    sizes.observe(element);
    const endControl = control({ element: screen, viewer, onClick: (at) => onClick.current?.(at) });
    const lost = (event: Event): void => {
      event.preventDefault();
      setState({ state: 'lost' });
    };
    screen.addEventListener('webglcontextlost', lost);
    setState({ state: 'ready', viewer });
    return () => {
      screen.removeEventListener('webglcontextlost', lost);
      endControl();
      sizes.disconnect();
      viewer.dispose();
    };
  }, []);
  return state;
}

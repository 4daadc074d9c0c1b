// The border between the pictures before and after: drawn by hand, or moved by the arrow keys.

import { useRef } from 'preact/hooks';

export interface SwipeProps {
  /** From 0 (left edge) to 100. */
  at: number;
  onMove: (at: number) => void;
  before: string;
  after: string;
}

const kStep = 4;

export function Swipe({ at, onMove, before, after }: SwipeProps) {
  const bar = useRef<HTMLDivElement>(null);
  const moveTo = (percent: number): void => onMove(Math.round(Math.min(100, Math.max(0, percent)) * 10) / 10);
  const drag = (event: PointerEvent): void => {
    const stage = bar.current?.parentElement?.getBoundingClientRect();
    if (stage && event.buttons !== 0) moveTo(((event.clientX - stage.left) / stage.width) * 100);
  };
  const key = (event: KeyboardEvent): void => {
    const to = { ArrowLeft: at - kStep, ArrowRight: at + kStep, Home: 0, End: 100 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    moveTo(to);
  };
  return (
    <>
      <p class="scene-side scene-side-before">{before}</p>
      <p class="scene-side scene-side-after">{after}</p>
      <div
        ref={bar}
        class="scene-swipe"
        style={{ left: `${at}%` }}
        role="slider"
        tabIndex={0}
        aria-label="Border between before and after"
        aria-valuemin={0}
        aria-valuemax={100}
        aria-valuenow={Math.round(at)}
        aria-valuetext={`${Math.round(at)} % before, ${Math.round(100 - at)} % after`}
        onPointerDown={(event) => {
          event.currentTarget.setPointerCapture(event.pointerId);
          drag(event);
        }}
        onPointerMove={drag}
        onKeyDown={key}
      >
        <span aria-hidden="true">‹ ›</span>
      </div>
    </>
  );
}

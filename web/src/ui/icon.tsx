// Line icons, drawn here: a picture never stands without a word or a label.

const kPaths = {
  overview: 'M3 13h8V3H3zM13 21h8V11h-8zM13 3v4h8V3zM3 17v4h8v-4z',
  alert: 'M12 3 2.5 20h19zM12 9v5M12 17.2v.1',
  change: 'M12 3 4 7.5v9L12 21l8-4.5v-9zM4 7.5l8 4.5 8-4.5M12 12v9',
  history: 'M3 12a9 9 0 1 0 3-6.7L3 8M3 3v5h5M12 7v5l3.5 2',
  zone: 'M5 8 14 4l6 6-4 9-10-2zM5 8v.1M14 4v.1M20 10v.1M16 19v.1M6 17v.1',
  rule: 'M4 6h10M18 6h2M4 12h3M11 12h9M4 18h9M17 18h3M14 4v4M7 10v4M13 16v4',
  scan: 'M12 20a2 2 0 1 0 0-4 2 2 0 0 0 0 4M12 18 4 6M12 18l8-12M3 10c5-6 13-6 18 0',
  compare: 'M4 4h7v16H4zM15 4h5v5M20 15v5h-5M15 12h1M19 12h1',
  sensor: 'M12 13v8M8 21h8M12 13a4 4 0 1 0 0-8 4 4 0 0 0 0 8M5 3a9 9 0 0 0 0 12M19 3a9 9 0 0 1 0 12',
  baseline: 'M4 19h16M4 15l5-5 4 3 7-8',
  silence: 'M6 9a6 6 0 0 1 9-5M18 9c0 5 2 7 2 7H8M6 9c0 5-2 7-2 7M10 20a2 2 0 0 0 4 0M3 3l18 18',
  delivery: 'M3 11 21 3l-7 18-3-7zM11 14 21 3',
  channel: 'M4 10v4h4l6 4V6L8 10zM17 9a4 4 0 0 1 0 6M19.5 6.5a8 8 0 0 1 0 11',
  storage: 'M4 6c0-4 16-4 16 0v12c0 4-16 4-16 0zM4 6c0 4 16 4 16 0M4 12c0 4 16 4 16 0',
  survey: 'M3 20h18M3 20l6-9 4 5 3-4 5 8M7 5h6M10 2v6',
  menu: 'M4 6h16M4 12h16M4 18h16',
  close: 'M5 5l14 14M19 5 5 19',
  check: 'M4 12.5 9.5 18 20 6',
  clock: 'M12 21a9 9 0 1 0 0-18 9 9 0 0 0 0 18M12 7v5l3 2',
  person: 'M12 12a4 4 0 1 0 0-8 4 4 0 0 0 0 8M4 21c0-9 16-9 16 0',
  theme:
    'M12 17a5 5 0 1 0 0-10 5 5 0 0 0 0 10M12 1v2M12 21v2M1 12h2M21 12h2M4 4l1.5 1.5M18.5 18.5 20 20M4 20l1.5-1.5M18.5 5.5 20 4',
  help: 'M9 9a3 3 0 1 1 4.5 2.6c-1 .6-1.5 1.2-1.5 2.4M12 17.5v.1M12 21a9 9 0 1 0 0-18 9 9 0 0 0 0 18',
  added: 'M12 4v16M4 12h16',
  removed: 'M4 12h16',
  discrepancy: 'M4 9c4-4 7 4 11 0 2-2 4-2 5-1M4 16c4-4 7 4 11 0 2-2 4-2 5-1',
  upload: 'M12 16V4M7 9l5-5 5 5M4 16v4h16v-4',
  next: 'M9 5l7 7-7 7',
  back: 'M15 5l-7 7 7 7',
  whole: 'M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5',
  live: 'M5 12a7 7 0 0 1 14 0M8.5 13a3.5 3.5 0 0 1 7 0M12 15.5v5',
} as const;

export type IconName = keyof typeof kPaths;

export function Icon({ name }: { name: IconName }) {
  return (
    <svg class="icon" viewBox="0 0 24 24" aria-hidden="true" focusable="false">
      <path d={kPaths[name]} />
    </svg>
  );
}

// Files on their way to the daemon, one after the other, whatever view is shown meanwhile.

export interface Upload {
  readonly id: number;
  readonly name: string;
  readonly size_bytes: number;
  readonly sent_bytes: number;
  readonly state: 'waiting' | 'sending' | 'stored' | 'known' | 'failed';
  /** Of what was stored: the scan. */
  readonly scan?: number;
  /** Of what failed: why, in the daemon's words. */
  readonly problem?: string;
}

export type UploadAction =
  | { type: 'upload/added'; uploads: readonly Upload[] }
  | { type: 'upload/changed'; id: number; change: Partial<Upload> }
  | { type: 'upload/forgotten' };

export function reduceUploads(uploads: readonly Upload[], action: UploadAction): readonly Upload[] {
  switch (action.type) {
    case 'upload/added':
      return [...uploads, ...action.uploads];
    case 'upload/changed':
      return uploads.map((upload) => (upload.id === action.id ? { ...upload, ...action.change } : upload));
    case 'upload/forgotten':
      return uploads.filter((upload) => upload.state === 'waiting' || upload.state === 'sending');
  }
}

/** Scan files with the side-car of each, if it was given, too: "tonight.pcd" and "tonight.pcd.json". */
export function withSideCars<F extends { readonly name: string }>(
  files: readonly F[],
): { file: F; sideCar: F | undefined }[] {
  const isSideCar = (file: F): boolean =>
    file.name.endsWith('.json') && files.some((other) => `${other.name}.json` === file.name);
  return files
    .filter((file) => !isSideCar(file))
    .map((file) => ({ file, sideCar: files.find((other) => other.name === `${file.name}.json`) }));
}

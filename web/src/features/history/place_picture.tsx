// The site from above: a click asks that place.

import { useMemo, useState } from 'preact/hooks';
import { metres } from '../../lib/format';
import { isPoint, type Place, pointPlace, type Vector3 } from '../../lib/place';
import { type Overlay } from '../../ui/top_view/overlays';
import { useScene } from '../../ui/top_view/scene';
import { type PickedPlace, TopView } from '../../ui/top_view/top_view';

/** Where nothing stands, the place is asked so far above the ground. */
const kAboveGround_m = 0.25;
/** What is lower than this is ground. */
const kStanding_m = 0.15;
/** So much of the site is shown around a place. */
const kAround_m = 12;

/** In the middle of what stands there, or a little above the ground. */
function placeAt({ place_m, ground_m = 0, top_m = ground_m }: PickedPlace): Place {
  const standing_m = top_m - ground_m;
  const above_m = standing_m > kStanding_m ? standing_m / 2 : kAboveGround_m;
  return pointPlace([place_m[0], place_m[1], ground_m + above_m]);
}

const middleOf = ({ min_m, max_m }: Place): Vector3 =>
  min_m.map((part, axis) => (part + (max_m[axis] ?? part)) / 2) as unknown as Vector3;

export function PlacePicture({
  site,
  place,
  onPlace,
}: {
  site: string;
  place: Place | undefined;
  onPlace: (place: Place) => void;
}) {
  const scene = useScene(site);
  const [picked, setPicked] = useState<PickedPlace | undefined>();
  const overlays = useMemo(() => overlaysOf(place), [JSON.stringify(place)]);
  // Only the place that the link brought is brought into view; what is clicked is there already.
  const [focus_m] = useState(() => {
    const [x, y] = place ? middleOf(place) : [];
    if (x === undefined || y === undefined) return undefined;
    return { min: [x - kAround_m, y - kAround_m], max: [x + kAround_m, y + kAround_m] } as const;
  });
  return (
    <div class="place-picture">
      <TopView
        scene={scene}
        label={`${site} from above: a click asks a place`}
        overlays={overlays}
        focus_m={focus_m}
        onPick={(at) => {
          setPicked(at);
          onPlace(placeAt(at));
        }}
      />
      <p class="muted" role="status">
        {picked ? pickedInWords(picked) : 'Click a place to see it through time, or give its coordinates below.'}
      </p>
    </div>
  );
}

function pickedInWords(picked: PickedPlace): string {
  const [, , z_m] = placeAt(picked).min_m;
  if (picked.ground_m === undefined) return `Nothing was seen there; asked at a height of ${metres(z_m)}.`;
  const stands = (picked.top_m ?? picked.ground_m) - picked.ground_m > kStanding_m;
  return stands
    ? `Something stands there; asked at half its height, at ${metres(z_m)}.`
    : `Asked ${metres(kAboveGround_m)} above the ground there, at ${metres(z_m)}.`;
}

function overlaysOf(place: Place | undefined): Overlay[] {
  if (!place) return [];
  const [x, y] = middleOf(place);
  const mark: Overlay = { kind: 'mark', at_m: [x, y], tone: 'accent' };
  if (isPoint(place)) return [mark];
  const { min_m, max_m } = place;
  const corners_m = [
    [min_m[0], min_m[1]],
    [max_m[0], min_m[1]],
    [max_m[0], max_m[1]],
    [min_m[0], max_m[1]],
  ] as const;
  return [mark, { kind: 'outline', corners_m, tone: 'accent' }];
}

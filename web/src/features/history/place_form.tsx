// Which place is asked about, by numbers: a point, or a box around it.

import { useState } from 'preact/hooks';
import { isPoint, type Place, pointPlace, type Vector3 } from '../../lib/place';

const kAxes = ['x', 'y', 'z'] as const;
const kSides = ['length, x', 'width, y', 'height, z'] as const;

interface Values {
  readonly centre: readonly string[];
  readonly size: readonly string[];
}

const round = (value: number): string => String(Number(value.toFixed(3)));

function valuesOf(place: Place | undefined): Values {
  if (!place) return { centre: ['', '', ''], size: ['', '', ''] };
  const { min_m, max_m } = place;
  return {
    centre: min_m.map((part, axis) => round((part + (max_m[axis] ?? part)) / 2)),
    size: isPoint(place) ? ['', '', ''] : min_m.map((part, axis) => round((max_m[axis] ?? part) - part)),
  };
}

/** A box when all three sides are given, else the point; nothing while a number is missing. */
function placeFrom({ centre, size }: Values): Place | undefined {
  if (centre.some((part) => part === '' || !Number.isFinite(Number(part)))) return undefined;
  const at = centre.map(Number);
  const half = size.map((side) => Number(side) / 2);
  if (half.some((side) => !(side > 0))) return pointPlace(at);
  const corner = (sign: 1 | -1): Vector3 =>
    at.map((part, axis) => part + sign * (half[axis] ?? 0)) as unknown as Vector3;
  return { min_m: corner(-1), max_m: corner(1) };
}

export function PlaceForm({ place, onPlace }: { place: Place | undefined; onPlace: (place: Place) => void }) {
  const [values, setValues] = useState(() => valuesOf(place));
  const change = (part: keyof Values, index: number, text: string): void =>
    setValues({ ...values, [part]: values[part].map((old, at) => (at === index ? text : old)) });
  const given = placeFrom(values);
  const sides = values.size.filter((side) => side !== '').length;
  return (
    <form
      class="panel-body"
      onSubmit={(event) => {
        event.preventDefault();
        if (given) onPlace(given);
      }}
    >
      <fieldset class="numbers">
        <legend>Where (m, in the frame of the site)</legend>
        {kAxes.map((axis, index) => (
          <label key={axis} class="field">
            {axis}
            <input
              type="number"
              step="any"
              required
              value={values.centre[index]}
              onInput={(event) => change('centre', index, event.currentTarget.value)}
            />
          </label>
        ))}
      </fieldset>
      <fieldset class="numbers">
        <legend>Size of a box around it (m); none: the point itself</legend>
        {kSides.map((side, index) => (
          <label key={side} class="field">
            {side}
            <input
              type="number"
              step="any"
              min="0.01"
              placeholder="–"
              required={sides > 0}
              value={values.size[index]}
              onInput={(event) => change('size', index, event.currentTarget.value)}
            />
          </label>
        ))}
      </fieldset>
      <div class="actions">
        <button type="submit" class="primary">
          Ask this place
        </button>
      </div>
    </form>
  );
}

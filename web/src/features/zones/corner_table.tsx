import { Icon } from '../../ui/icon';
import { type Dispatch } from './drawing';
import { type OutlineEdit } from './outline_edit';

/** The outline in numbers. */
export function CornerTable({ edit, dispatch }: { edit: OutlineEdit; dispatch: Dispatch }) {
  const { corners } = edit;
  if (corners.length === 0) return <p class="muted">No corner yet: click on the picture, or add one here.</p>;
  return (
    <div class="table-scroll corner-table" tabIndex={0} role="region" aria-label="corners">
      <table>
        <caption class="visually-hidden">corners</caption>
        <thead>
          <tr>
            <th scope="col">Corner</th>
            <th scope="col">x (m)</th>
            <th scope="col">y (m)</th>
            <th scope="col">
              <span class="visually-hidden">Add or take away</span>
            </th>
          </tr>
        </thead>
        <tbody>
          {corners.map((corner, index) => (
            <tr key={index} class={index === edit.held ? 'corner-held' : undefined}>
              <th scope="row">{index + 1}</th>
              {([0, 1] as const).map((axis) => (
                <td key={axis}>
                  <input
                    type="number"
                    step="any"
                    required
                    aria-label={`${axis === 0 ? 'x' : 'y'} of corner ${index + 1} in metres`}
                    value={corner[axis]}
                    onFocus={() => dispatch({ type: 'held', corner: index })}
                    onChange={(event) => {
                      const value = event.currentTarget.valueAsNumber;
                      if (Number.isNaN(value)) event.currentTarget.value = String(corner[axis]);
                      else
                        dispatch({
                          type: 'moved',
                          corner: index,
                          to: axis === 0 ? [value, corner[1]] : [corner[0], value],
                        });
                    }}
                  />
                </td>
              ))}
              <td class="corner-actions">
                <button
                  type="button"
                  class="quiet"
                  aria-label={`Add a corner after ${index + 1}`}
                  onClick={() => dispatch({ type: 'inserted', after: index, at: between(edit, index) })}
                >
                  <Icon name="added" />
                </button>
                <button
                  type="button"
                  class="quiet"
                  aria-label={`Take corner ${index + 1} away`}
                  onClick={() => dispatch({ type: 'removed', corner: index })}
                >
                  <Icon name="close" />
                </button>
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function between({ corners }: OutlineEdit, index: number): readonly [number, number] {
  const corner = corners[index] ?? [0, 0];
  const next = corners[(index + 1) % corners.length] ?? corner;
  if (corners.length === 1) return [corner[0] + 1, corner[1]];
  return [(corner[0] + next[0]) / 2, (corner[1] + next[1]) / 2];
}

// The menu: the views by what somebody comes for. A view of the menu that no group names stands in the last one.

import { groupsOf } from './menu_groups';
import { kViews } from './views';

export const kMenu = groupsOf(kViews.filter((view) => view.menu));

// What the table of views loads in one piece.

export { ChannelView, NewChannelView } from './channel_view';
export { ChannelsView } from './channels_view';
export { DeliveriesView } from './deliveries_view';

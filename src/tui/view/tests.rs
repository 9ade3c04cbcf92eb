//! What stands on the screen whatever the pane.

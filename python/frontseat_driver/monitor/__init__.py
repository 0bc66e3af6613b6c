"""frontseat_monitor: a terminal screen for the person on deck."""

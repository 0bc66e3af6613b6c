"""nmea_plot: one page that shows a mission."""

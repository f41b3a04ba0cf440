"""rosbag2 MCAP bags: written, read, repaired and plotted."""

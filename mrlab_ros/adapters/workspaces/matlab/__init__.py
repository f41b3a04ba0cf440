"""MATLAB files: version 5, 7.3 (HDF5) and the objects in them."""

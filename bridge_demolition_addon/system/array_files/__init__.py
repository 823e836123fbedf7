"""Files of arrays: tables that grow row by row, and archives that can be read in part."""

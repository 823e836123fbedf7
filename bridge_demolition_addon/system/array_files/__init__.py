"""Files of arrays: tables that grow row by row, and archives of which a part can be read."""

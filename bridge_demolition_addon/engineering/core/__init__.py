"""The compiled core: its library of C functions, and the structs in which arrays are handed to it."""

"""Camera, pictures, films and body colours."""

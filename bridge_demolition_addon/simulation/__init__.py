"""One step of data flow: from Bullet through the recorder into logs."""

"""From Bullet to logs and arrays."""

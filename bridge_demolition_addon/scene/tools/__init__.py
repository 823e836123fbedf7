"""What animation moves: ball, cable and jackhammer, and ground that shakes."""

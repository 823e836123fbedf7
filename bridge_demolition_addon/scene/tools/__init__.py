"""Ball, cable and jackhammer, with their keyframes."""

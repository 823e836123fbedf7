"""Studies: many draws of one scenario, each in a process of its own, on this machine or on a cluster."""

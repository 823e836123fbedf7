"""Air blast of bare charges: from a charge and a stand-off to the impulse on a body."""

"""Stages: how a bridge stands between the steps of its demolition, by the stiffness of its connections."""

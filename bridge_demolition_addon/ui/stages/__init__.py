"""Stages: does the bridge stand between the steps of its demolition?"""

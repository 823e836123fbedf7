# SPDX-License-Identifier: GPL-3.0-or-later
"""Bridge Demolition Add-on: plan the demolition of a bridge with Blender's rigid bodies."""

"""Meshes of elements for solvers, their files, and fields that solvers have computed."""

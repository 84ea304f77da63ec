# SPDX-License-Identifier: AGPL-3.0-or-later
# The rules of cases/Makefile for the cases and runs of verify.py, in cases/ and runs/ of the folder of the call.
TOP := $(CURDIR)
include $(dir $(lastword $(MAKEFILE_LIST)))../../cases/Makefile

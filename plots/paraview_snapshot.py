#!/usr/bin/env pvpython
"""A picture of one snapshot, or of every snapshot of a series, drawn by ParaView.

    xvfb-run -a pvbatch plots/paraview_snapshot.py RUN/bar_particles.hdf.series plastic_strain picture.png [POINT_SIZE]

Give several inputs separated by commas to show several bodies. Of a series the last time is shown.
"""
import os
import sys

from paraview.simple import (ColorBy, CreateRenderView, GetColorTransferFunction, GetScalarBar, OpenDataFile, SaveScreenshot, Show)

if len(sys.argv) < 4:
    sys.exit(__doc__)
inputs, field, picture = sys.argv[1].split(","), sys.argv[2], sys.argv[3]
point_size = float(sys.argv[4]) if len(sys.argv) > 4 else 4.0

view = CreateRenderView(ViewSize=[1200, 900], Background=[1, 1, 1], OrientationAxesLabelColor=[0, 0, 0])
for name in inputs:
    body = OpenDataFile(os.path.abspath(name))  # a relative path would be sought beside the program
    body.UpdatePipeline()
    times = getattr(body, "TimestepValues", None)
    if times is not None and len(times) > 0:
        view.ViewTime = times[-1]
        body.UpdatePipeline(times[-1])
    display = Show(body, view)
    display.SetRepresentationType("Points")
    display.PointSize = point_size
    display.RenderPointsAsSpheres = 1
    ColorBy(display, ("POINTS", field))
    display.RescaleTransferFunctionToDataRange(True)
    display.SetScalarBarVisibility(view, True)
bar = GetScalarBar(GetColorTransferFunction(field), view)
bar.Title, bar.ComponentTitle = field.replace("_", " "), ""
bar.TitleColor = bar.LabelColor = [0, 0, 0]
view.ResetCamera()
SaveScreenshot(os.path.abspath(picture), view)

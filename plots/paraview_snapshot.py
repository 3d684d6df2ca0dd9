#!/usr/bin/env pvpython
"""A picture of snapshots, drawn by ParaView: particles (.hdf, .hdf.series) as points, the grid (.vti, .pvd) as a surface.

    xvfb-run -a pvbatch plots/paraview_snapshot.py INPUT[,INPUT...] FIELD PICTURE.png [TIME]

Several inputs are shown together. Of a series the last time is shown, or the one nearest to TIME (s). Of a vector the
magnitude is shown; of the grid only what has mass.
"""
import os
import sys

from paraview.simple import (ColorBy, CreateRenderView, GetColorTransferFunction, GetScalarBar,
                             OpenDataFile, SaveScreenshot, Show, Text, Threshold)


def open_at(name, wanted):
    """The source of a file and the time it is shown at."""
    if not os.path.exists(name):
        sys.exit(f"{name}: there is no such file")
    damaged = f"{name}: nothing could be read from it; is it damaged? `brisance report` on its directory tells"
    try:
        source = OpenDataFile(os.path.abspath(name))  # a relative path would be sought beside the program
    except RuntimeError:
        sys.exit(damaged)
    source.UpdatePipeline()
    times = list(getattr(source, "TimestepValues", None) or [])
    time = min(times, key=lambda t: abs(t - wanted)) if times and wanted is not None else times[-1] if times else 0.0
    source.UpdatePipeline(time)
    if source.GetDataInformation().GetNumberOfPoints() == 0:
        sys.exit(damaged)
    return source, time


def main(inputs, field, picture, wanted=None):
    sources = [(name, *open_at(name, None if wanted is None else float(wanted))) for name in inputs.split(",")]
    view = CreateRenderView(ViewSize=[900, 1000], UseColorPaletteForBackground=0, Background=[1, 1, 1],
                            OrientationAxesLabelColor=[0, 0, 0])
    colours = GetColorTransferFunction(field)
    colours.ApplyPreset("Viridis (matplotlib)", True)
    ranges = []
    for name, source, time in sources:
        is_grid = name.endswith((".vti", ".pvd"))
        if is_grid and "mass" in source.PointData.keys():
            source = Threshold(Input=source, Scalars=["POINTS", "mass"], LowerThreshold=1e-300, UpperThreshold=1e300,
                               AllScalars=1)
            source.UpdatePipeline(time)
        where, data = ("POINTS", source.PointData) if field in source.PointData.keys() else ("CELLS", source.CellData)
        if field not in data.keys():
            known = sorted(source.PointData.keys() + source.CellData.keys())
            sys.exit(f"{name}: there is no field {field}; there are {', '.join(known)}")
        ranges.append(data[field].GetRange(-1 if data[field].GetNumberOfComponents() > 1 else 0))
        view.ViewTime = time
        display = Show(source, view)
        display.SetRepresentationType("Surface" if is_grid else "Points")
        display.Ambient, display.Diffuse = 0.5, 0.5  # colours nearly as the scale shows them
        if not is_grid:
            display.RenderPointsAsSpheres = 1
            display.PointSize = point_size(source, view)
        ColorBy(display, (where, field))
        display.SetScalarBarVisibility(view, True)
        x0, x1, y0, y1, z0, z1 = source.GetDataInformation().GetBounds()
    lowest, highest = min(low for low, _ in ranges), max(high for _, high in ranges)
    colours.RescaleTransferFunction(lowest, highest if highest > lowest else lowest + 1.0)
    bar = GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = field.replace("_", " "), ""
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.RangeLabelFormat = bar.LabelFormat = "%-#.3g"
    Show(Text(Text=f"t = {time:.4g} s"), view).Color = [0, 0, 0]
    view.ResetCamera()
    if z1 > z0:  # from beside and above
        view.GetActiveCamera().Azimuth(-50)
        view.GetActiveCamera().Elevation(15)
        view.ResetCamera()
    SaveScreenshot(os.path.abspath(picture), view)


def point_size(source, view):
    """Pixels across a particle, as if they filled the box around them evenly."""
    x0, x1, y0, y1, z0, z1 = source.GetDataInformation().GetBounds()
    sides = [s for s in (x1 - x0, y1 - y0, z1 - z0) if s > 0.0]
    volume = 1.0
    for side in sides:
        volume *= side
    spacing = (volume / source.GetDataInformation().GetNumberOfPoints()) ** (1.0 / max(1, len(sides)))
    return max(2.0, 1.3 * spacing / max(sides or [1.0]) * min(view.ViewSize))


if len(sys.argv) not in (4, 5):
    sys.exit(__doc__)
main(*sys.argv[1:])

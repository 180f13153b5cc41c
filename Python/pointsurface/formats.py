# SPDX-License-Identifier: BSD-3-Clause
"""What VTK reads that holds points or volumes: a row for each extension.

It needs VTK alone, so that a file can be tried in a process that loads little.
"""

import sys

if __name__ == "__main__" and not getattr(sys.flags, "safe_path", False):
    del sys.path[0]  # the folder of the package, whose modules are not to be taken for others of their names

import importlib
from typing import NamedTuple


class Format(NamedTuple):
    """The reader of VTK's for an extension: its module in vtkmodules, its name, how it takes the path, and whether it is
    tried first: on files that are broken it crashes, or prints a line and goes on."""

    module: str
    reader: str
    takes_path: str = "SetFileName"
    is_tried: bool = True


_XML = Format("vtkIOXML", "vtkXMLGenericDataObjectReader", is_tried=False)
_META = Format("vtkIOImage", "vtkMetaImageReader")
_NRRD = Format("vtkIOImage", "vtkNrrdReader", is_tried=False)
_NIFTI = Format("vtkIOImage", "vtkNIFTIImageReader", is_tried=False)
_TIFF = Format("vtkIOImage", "vtkTIFFReader")
_GLTF = Format("vtkIOGeometry", "vtkGLTFReader", is_tried=False)
_SEGY = Format("vtkIOSegY", "vtkSegYReader")
_ENSIGHT = Format("vtkIOEnSight", "vtkGenericEnSightReader", takes_path="SetCaseFileName")
_EXODUS = Format("vtkIOExodus", "vtkExodusIIReader")
_HDF = Format("vtkIOHDF", "vtkHDFReader")
_NETCDF = Format("vtkIONetCDF", "vtkNetCDFCFReader")
_TECPLOT = Format("vtkIOGeometry", "vtkTecplotReader")
_XDMF = Format("vtkIOXdmf2", "vtkXdmfReader")

FORMATS = {
    # one or the other
    "vtk": Format("vtkIOLegacy", "vtkGenericDataObjectReader"),
    "hdf": _HDF,
    "vtkhdf": _HDF,
    "nc": _NETCDF,
    "ncdf": _NETCDF,
    "xdmf": _XDMF,
    "xmf": _XDMF,
    # volumes
    "dcm": Format("vtkIOImage", "vtkDICOMImageReader", takes_path="SetDirectoryName"),
    "mha": _META,
    "mhd": _META,
    "mnc": Format("vtkIOMINC", "vtkMINCImageReader"),
    "mrc": Format("vtkIOImage", "vtkMRCReader", is_tried=False),
    "nhdr": _NRRD,
    "nii": _NIFTI,
    "nii.gz": _NIFTI,
    "nrrd": _NRRD,
    "pvti": _XML,
    "slc": Format("vtkIOImage", "vtkSLCReader"),
    "tif": _TIFF,
    "tiff": _TIFF,
    "vti": Format("vtkIOXML", "vtkXMLImageDataReader", is_tried=False),
    "vtr": _XML,
    # points, alone or of meshes
    "byu": Format("vtkIOGeometry", "vtkBYUReader"),
    "glb": _GLTF,
    "gltf": _GLTF,
    "gml": Format("vtkIOCityGML", "vtkCityGMLReader"),
    "obj": Format("vtkIOGeometry", "vtkOBJReader", is_tried=False),
    "off": Format("vtkIOGeometry", "vtkOFFReader"),
    "pdb": Format("vtkIOChemistry", "vtkPDBReader"),
    "ply": Format("vtkIOPLY", "vtkPLYReader"),
    "pvtp": _XML,
    "stl": Format("vtkIOGeometry", "vtkSTLReader", is_tried=False),
    "tag": Format("vtkIOMINC", "vtkMNITagPointReader"),
    "vtp": Format("vtkIOXML", "vtkXMLPolyDataReader", is_tried=False),
    # points of grids
    "cas": Format("vtkIOGeometry", "vtkFLUENTReader"),
    "case": _ENSIGHT,
    "cgns": Format("vtkIOCGNSReader", "vtkCGNSReader"),
    "e": _EXODUS,
    "encas": _ENSIGHT,
    "ex2": _EXODUS,
    "exii": _EXODUS,
    "exo": _EXODUS,
    "foam": Format("vtkIOGeometry", "vtkOpenFOAMReader"),
    "inp": Format("vtkIOGeometry", "vtkAVSucdReader"),
    "neu": Format("vtkIOGeometry", "vtkGAMBITReader"),
    "p3d": Format("vtkIOParallel", "vtkPlot3DMetaReader"),
    "pvts": _XML,
    "pvtu": _XML,
    "segy": _SEGY,
    "sgy": _SEGY,
    "tec": _TECPLOT,
    "tp": _TECPLOT,
    "vrt": Format("vtkIOGeometry", "vtkProStarReader"),
    "vts": _XML,
    "vtu": _XML,
    # trees
    "vtm": _XML,
    "vtmb": _XML,
    "vtpc": Format("vtkIOXML", "vtkXMLPartitionedDataSetCollectionReader"),
    "vtpd": Format("vtkIOXML", "vtkXMLPartitionedDataSetReader"),
}


def reader_class(form):
    """Raises ImportError or AttributeError where this VTK has no such module or class."""
    return getattr(importlib.import_module(f"vtkmodules.{form.module}"), form.reader)


def make_reader(form, path):
    """A reader that has been told the path, and to read all arrays of points."""
    reader = reader_class(form)()
    getattr(reader, form.takes_path)(path)
    if form.reader == "vtkExodusIIReader":
        reader.UpdateInformation()
        reader.SetAllArrayStatus(reader.NODAL, 1)
    elif hasattr(reader, "EnableAllPointArrays"):
        reader.UpdateInformation()
        reader.EnableAllPointArrays()
    return reader


if __name__ == "__main__":
    make_reader(FORMATS[sys.argv[1]], sys.argv[2]).Update()

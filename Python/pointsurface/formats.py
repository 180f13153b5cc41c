# SPDX-License-Identifier: BSD-3-Clause
"""What VTK reads that holds points or volumes: a row for each extension.

It needs VTK alone, so that a file can be tried in a process that loads little.
"""

import sys

if __name__ == "__main__" and not getattr(sys.flags, "safe_path", False):
    del sys.path[0]  # the folder of the package, whose modules are not to be taken for others of their names

import glob
import importlib
import json
import mmap
import os
from contextlib import contextmanager
from typing import NamedTuple

from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkParallelCore import vtkDummyController, vtkMultiProcessController


class Format(NamedTuple):
    """The reader or importer of VTK's for an extension: its module in vtkmodules, its name, how it takes the path, whether
    it is tried first (on files that are broken it crashes, or prints a line and goes on), which output is taken, and
    where it prints something whatever it reads (1: standard output, 2: standard error)."""

    module: str
    reader: str
    takes_path: str = "SetFileName"
    is_tried: bool = True
    port: int = 0
    prints: int = 0


_AMR = Format("vtkIOXML", "vtkXMLUniformGridAMRReader", is_tried=False)
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
_VRML = Format("vtkIOImport", "vtkVRMLImporter")
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
    "pvtk": Format("vtkIOParallel", "vtkPDataSetReader"),
    # volumes
    "cube": Format("vtkIOChemistry", "vtkGaussianCubeReader2", port=1),
    "dcm": Format("vtkIOImage", "vtkDICOMImageReader", takes_path="SetDirectoryName"),
    "h": Format("vtkIOImage", "vtkSEPReader"),
    "h5rage": Format("vtkIOH5Rage", "vtkH5RageReader"),
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
    "vpc": Format("vtkIOVPIC", "vtkVPICReader"),
    "vti": Format("vtkIOXML", "vtkXMLImageDataReader", is_tried=False),
    "vtr": _XML,
    # volumes of levels, finer where that is needed (AMR)
    "amrex": Format("vtkIOAMR", "vtkAMReXGridReader"),
    "flash": Format("vtkIOAMR", "vtkAMRFlashReader"),
    "hierarchy": Format("vtkIOAMR", "vtkAMREnzoReader"),
    "vth": _AMR,
    "vthb": _AMR,
    "xamr": Format("vtkIOAMR", "vtkAMRVelodyneReader"),
    # points, alone or of meshes
    "3ds": Format("vtkIOImport", "vtk3DSImporter"),
    "b3dm": Format("vtkIOCesium3DTiles", "vtkCesiumB3DMReader"),
    "bts": Format("vtkIOEngys", "vtkBTSReader"),
    "byu": Format("vtkIOGeometry", "vtkBYUReader"),
    "cfg": Format("vtkIOMotionFX", "vtkMotionFXCFGReader"),
    "cml": Format("vtkIOChemistry", "vtkCMLMoleculeReader"),
    "facet": Format("vtkFiltersHybrid", "vtkFacetReader"),
    "geojson": Format("vtkIOGeoJSON", "vtkGeoJSONReader"),
    "glb": _GLTF,
    "gltf": _GLTF,
    "gml": Format("vtkIOCityGML", "vtkCityGMLReader"),
    "h5part": Format("vtkIOH5part", "vtkH5PartReader"),
    "json": Format("vtkIOCesium3DTiles", "vtkCesium3DTilesReader"),
    "obj": Format("vtkIOGeometry", "vtkOBJReader", is_tried=False),
    "off": Format("vtkIOGeometry", "vtkOFFReader"),
    "omf": Format("vtkIOOMF", "vtkOMFReader"),
    "out": Format("vtkIOChemistry", "vtkVASPAnimationReader"),
    "pdb": Format("vtkIOChemistry", "vtkPDBReader"),
    "ply": Format("vtkIOPLY", "vtkPLYReader"),
    "pvtp": _XML,
    "stl": Format("vtkIOGeometry", "vtkSTLReader", is_tried=False),
    "tag": Format("vtkIOMINC", "vtkMNITagPointReader"),
    "tri": Format("vtkIOGeometry", "vtkMCubesReader"),
    "vrml": _VRML,
    "vtp": Format("vtkIOXML", "vtkXMLPolyDataReader", is_tried=False),
    "wrl": _VRML,
    # points of grids
    "avm": Format("vtkIOAvmesh", "vtkAvmeshReader"),
    "cas": Format("vtkIOGeometry", "vtkFLUENTReader"),
    "cas.h5": Format("vtkIOFLUENTCFF", "vtkFLUENTCFFReader", prints=2),
    "case": _ENSIGHT,
    "cgns": Format("vtkIOCGNSReader", "vtkCGNSReader"),
    "d3plot": Format("vtkIOLSDyna", "vtkLSDynaReader"),
    "e": _EXODUS,
    "encas": _ENSIGHT,
    "erfh5": Format("vtkIOERF", "vtkERFReader", prints=2),
    "ex2": _EXODUS,
    "exii": _EXODUS,
    "exo": _EXODUS,
    "foam": Format("vtkIOGeometry", "vtkOpenFOAMReader"),
    "h5": Format("vtkIOCONVERGECFD", "vtkCONVERGECFDReader"),
    "htg": Format("vtkIOXML", "vtkXMLHyperTreeGridReader"),
    "inp": Format("vtkIOGeometry", "vtkAVSucdReader"),
    "nek5000": Format("vtkIOParallel", "vtkNek5000Reader", prints=1),
    "neu": Format("vtkIOGeometry", "vtkGAMBITReader"),
    "p3d": Format("vtkIOParallel", "vtkPlot3DMetaReader"),
    "pio": Format("vtkIOPIO", "vtkPIOReader"),
    "pvts": _XML,
    "pvtu": _XML,
    "res": Format("vtkIOGeometry", "vtkMFIXReader"),
    "segy": _SEGY,
    "sgy": _SEGY,
    "smv": Format("vtkIOFDS", "vtkFDSReader"),
    "sos": Format("vtkIOEnSight", "vtkEnSightSOSGoldReader", takes_path="SetCaseFileName"),
    "tec": _TECPLOT,
    "tp": _TECPLOT,
    "vrt": Format("vtkIOGeometry", "vtkProStarReader"),
    "vts": _XML,
    "vtu": _XML,
    "wind": Format("vtkIOGeometry", "vtkWindBladeReader", takes_path="SetFilename"),
    "x3d": Format("vtkIOLANLX3D", "vtkLANLX3DReader"),
    # trees
    "vtm": _XML,
    "vtmb": _XML,
    "vtpc": Format("vtkIOXML", "vtkXMLPartitionedDataSetCollectionReader"),
    "vtpd": Format("vtkIOXML", "vtkXMLPartitionedDataSetReader"),
}

# What has the extension of another format, and is told by its content.
BY_CONTENT = {
    "amrex": {"particles": Format("vtkIOAMR", "vtkAMReXParticlesReader", takes_path="SetPlotFileName")},
    "flash": {"particles": Format("vtkIOAMR", "vtkAMRFlashParticlesReader")},
    "h5": {
        "TRUCHAS": Format("vtkIOTRUCHAS", "vtkTRUCHASReader"),
        "VERA": Format("vtkIOVeraOut", "vtkVeraOutReader"),
    },
    "hierarchy": {"particles": Format("vtkIOAMR", "vtkAMREnzoParticlesReader")},
    "nc": {
        "CAM": Format("vtkIONetCDF", "vtkNetCDFCAMReader"),
        "MPAS": Format("vtkIONetCDF", "vtkMPASReader"),
        "SLAC": Format("vtkIONetCDF", "vtkSLACReader", takes_path="SetMeshFileName"),
        "SLAC particles": Format("vtkIONetCDF", "vtkSLACParticleReader"),
        "UGRID": Format("vtkIONetCDF", "vtkNetCDFUGRIDReader"),
    },
    "obj": {"MNI": Format("vtkIOMINC", "vtkMNIObjectReader")},
    "out": {"tessellation": Format("vtkIOChemistry", "vtkVASPTessellationReader")},
    "xyz": {"molecule": Format("vtkIOChemistry", "vtkXYZMolReader2")},
}
BY_CONTENT["ncdf"] = BY_CONTENT["nc"]


# VTK's other readers and importers, and why they have no row.
NOT_READ = {
    "what all readers of a kind share, not a format": """
        vtkAbstractPolyDataReader vtkAMRBaseParticlesReader vtkAMRBaseReader vtkDatabaseToTableReader vtkDataReader
        vtkEnSightReader vtkImageReader2Factory vtkImporter vtkMedicalImageReader2 vtkMoleculeReaderBase vtkParallelReader
        vtkReaderAlgorithm vtkSimpleReader vtkVolumeReader vtkXMLCompositeDataReader vtkXMLDataReader vtkXMLPDataObjectReader
        vtkXMLPDataReader vtkXMLPStructuredDataReader vtkXMLPUnstructuredDataReader vtkXMLReader vtkXMLStructuredDataReader
        vtkXMLUnstructuredDataReader""",
    "behind a reader of the table that finds out what a file holds": """
        vtkCompositeDataReader vtkDataObjectReader vtkDataSetReader vtkEnSight6BinaryReader vtkEnSight6Reader
        vtkEnSightGoldBinaryReader vtkEnSightGoldReader vtkMultiBlockPLOT3DReader vtkNetCDFReader vtkPolyDataReader
        vtkRectilinearGridReader vtkStructuredGridReader vtkStructuredPointsReader vtkUnstructuredGridReader
        vtkXMLHierarchicalBoxDataReader vtkXMLHierarchicalDataReader vtkXMLMultiBlockDataReader
        vtkXMLMultiGroupDataReader vtkXMLPHyperTreeGridReader vtkXMLPImageDataReader vtkXMLPPolyDataReader
        vtkXMLPRectilinearGridReader vtkXMLPStructuredGridReader vtkXMLPUnstructuredGridReader vtkXMLRectilinearGridReader
        vtkXMLStructuredGridReader vtkXMLUnstructuredGridReader""",
    "the same files as a reader of the table, by several processes or in another way": """
        vtkCGNSFileSeriesReader vtkCONVERGECFDCGNSReader vtkCPExodusIIInSituReader vtkEnSightGoldCombinedReader
        vtkEnSightMasterServerReader vtkGaussianCubeReader vtkGLTFImporter vtkIOSSReader vtkMPIImageReader
        vtkMPIMultiBlockPLOT3DReader vtkNetCDFPOPReader vtkOBJImporter vtkOMETIFFReader vtkPChacoReader
        vtkPExodusIIReader vtkPLSDynaReader vtkPNetCDFPOPReader vtkPNrrdReader vtkPOpenFOAMReader vtkPSLACReader
        vtkPWindBladeReader vtkRTXMLPolyDataReader vtkXYZMolReader""",
    "the module readers reads such text itself": "vtkPTSReader vtkParticleReader vtkSimplePointsReader",
    "tables, graphs, trees, transforms or models: neither points of a surface nor a volume": """
        vtkArrayDataReader vtkArrayReader vtkBiomTableReader vtkChacoGraphReader vtkChacoReader vtkDelimitedTextReader
        vtkDIMACSGraphReader vtkFixedWidthTextReader vtkGraphReader vtkISIReader vtkLegacyStatisticalModelReader
        vtkMNITransformReader vtkMultiNewickTreeReader vtkNewickTreeReader vtkPhyloXMLTreeReader vtkRISReader
        vtkSQLiteToTableReader vtkTableReader vtkTecplotTableReader vtkTemporalDelimitedTextReader vtkTreeReader
        vtkTulipReader vtkXGMLReader vtkXMLPTableReader vtkXMLStatisticalModelReader vtkXMLTableReader vtkXMLTreeReader""",
    "cells of any order (vtkCellGrid), which have no points": """
        vtkCellGridReader vtkCompositeCellGridReader vtkIOSSCellGridReader vtkLegacyCellGridReader""",
    "flat pictures, or slices with a file each": """
        vtkBMPReader vtkDEMReader vtkGESignaReader vtkHDRReader vtkJPEGReader vtkPNGReader vtkPNMReader vtkTGAReader""",
    "bytes whose sizes no header tells": "vtkImageReader vtkImageReader2 vtkVolume16Reader",
}


def reader_class(form):
    """Raises ImportError or AttributeError where this VTK has no such module or class."""
    return getattr(importlib.import_module(f"vtkmodules.{form.module}"), form.reader)


_WINDOW = 2**20  # bytes in which all names are looked for before the next ones


def names_in(path, wanted):
    """Yields those of `wanted`, some bytes, that a file has, from its end on; however many, it is gone through once."""
    size = os.path.getsize(path)
    if size == 0:
        return  # which cannot be mapped
    missing, longest = list(wanted), max(map(len, wanted))
    with open(path, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
        for end in range(size, 0, -_WINDOW):
            found = [name for name in missing if content.rfind(name, max(end - _WINDOW, 0), end + longest) >= 0]
            yield from found
            missing = [name for name in missing if name not in found]
            if not missing:
                return


def cells_of_cam(path):
    """The file, of those beside it, with the cells of its columns; None if there is none."""
    names = glob.iglob(os.path.join(glob.escape(os.path.dirname(os.path.abspath(path))), "*.nc"))
    return next((name for name in sorted(names) if any(names_in(name, [b"element_corners"]))), None)


class Scene:
    """An importer of VTK's in the guise of a reader: its output has a block for each actor, in its place."""

    def __init__(self, importer):
        from vtkmodules.vtkRenderingOpenGL2 import vtkGenericOpenGLRenderWindow  # the module makes actors and mappers, too

        importer.SetRenderWindow(vtkGenericOpenGLRenderWindow())  # it asks for no display, and nothing is drawn
        self._importer = importer
        self._output = vtkMultiBlockDataSet()

    def __getattr__(self, name):
        return getattr(self._importer, name)

    def Update(self):
        run = getattr(self._importer, "Update", None) or self._importer.Read  # the name until VTK 9.3
        run()
        actors = self._importer.GetRenderer().GetActors()
        for i in range(actors.GetNumberOfItems()):
            actor = actors.GetItemAsObject(i)
            mapper, place = actor.GetMapper(), vtkTransform()
            if mapper is None or mapper.GetNumberOfInputConnections(0) == 0:
                continue
            place.SetMatrix(actor.GetMatrix())
            moved = vtkTransformPolyDataFilter()
            moved.SetTransform(place)
            moved.SetInputConnection(mapper.GetInputConnection(0, 0))
            moved.Update()
            self._output.SetBlock(i, moved.GetOutput())

    def GetOutputDataObject(self, _port):
        return self._output


@contextmanager
def controller():
    """Some readers ask VTK's controller of processes who they are, and crash where there is none."""
    if vtkMultiProcessController.GetGlobalController() is not None:
        yield
        return
    alone = vtkDummyController()
    vtkMultiProcessController.SetGlobalController(alone)
    try:
        yield
    finally:
        vtkMultiProcessController.SetGlobalController(None)


def make_reader(form, path):
    """A reader that has been told the path, and to read all arrays."""
    if form.reader in ("vtkH5RageReader", "vtkPIOReader"):
        with controller():
            reader = reader_class(form)()
    else:
        reader = reader_class(form)()
    if form.reader == "vtkAMReXParticlesReader":
        folder, kind = os.path.split(os.path.abspath(path))
        reader.SetParticleType(kind)
        path = folder
    getattr(reader, form.takes_path)(path)
    if form.reader.endswith("Importer"):
        return Scene(reader)
    if form == _AMR:
        reader.SetMaximumLevelsToReadByDefault(0)  # which is all
    elif form.reader == "vtkExodusIIReader":
        reader.UpdateInformation()
        reader.SetAllArrayStatus(reader.NODAL, 1)
    elif form.reader == "vtkFDSReader":
        for part in ("Devices", "Slices", "Boundaries"):  # and not the grids that they are in
            reader.AddSelector(f"//{part}")
    elif form.reader == "vtkAMREnzoParticlesReader":
        reader.SetParticleType(0)  # which is all
        reader.Update()  # it knows of no arrays before
        for i in range(reader.GetNumberOfParticleArrays()):
            reader.SetParticleArrayStatus(reader.GetParticleArrayName(i), 1)
    elif form.reader == "vtkNetCDFCAMReader":
        reader.SetConnectivityFileName(cells_of_cam(path))
    elif form.reader == "vtkVeraOutReader":
        reader.UpdateInformation()
        reader.GetOutputInformation(0).Set(vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP(), 1.0)  # steps begin there
    elif form.reader == "vtkSLACReader":
        reader.ReadMidpointsOff()  # of edges, which few meshes have
    elif form.reader == "vtkCesium3DTilesReader":
        reader.SetLevel(1000)  # the finest tiles there are
    elif hasattr(reader, "EnableAllPointArrays"):
        reader.UpdateInformation()
        reader.EnableAllPointArrays()
    elif form.module == "vtkIOAMR" and "Particles" not in form.reader:
        reader.UpdateInformation()
        reader.SetMaxLevel(reader.GetNumberOfLevels())
        for i in range(reader.GetNumberOfCellArrays()):
            reader.SetCellArrayStatus(reader.GetCellArrayName(i), 1)
    return reader


if __name__ == "__main__":
    make_reader(Format(*json.loads(sys.argv[1])), sys.argv[2]).Update()

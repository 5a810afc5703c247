# SPDX-License-Identifier: BSD-3-Clause
"""Results of the library, as tuples with names. Lengths are model lengths, angles degrees, times seconds.

Written by cabi/python/generate.py: not to be edited."""

from __future__ import annotations

from typing import Any, NamedTuple

from . import _declarations as c


class ErrorPlace(NamedTuple):
    """The place of the last error."""

    face: int
    ic: int
    curve: int
    point: int
    line: int
    uv: tuple[float, float]
    t: float


class Parameter(NamedTuple):
    """The properties of a parameter that do not depend on its value."""

    name: str
    help: str
    default_text: str
    choices: str
    minimum: float
    maximum: float
    default_number: float
    type: int
    diag_relative: int
    set_by: str


class Report(NamedTuple):
    """Counts and times of the last successful run."""

    diag: float
    surf0_calls: int
    surf1_calls: int
    surf2_calls: int
    curv0_calls: int
    curv1_calls: int
    curv2_calls: int
    size_calls: int
    seconds_curves: float
    seconds_sampling: float
    seconds_plane: float
    seconds_lift: float
    seconds_total: float


class Interface(NamedTuple):
    """A curve of space and its places, the curves of faces that it is."""

    curve: int
    uses: int
    face: int
    ic: int
    other_face: int
    other_ic: int
    boundary: int
    glued: int
    degenerate: int
    loose: int
    gap: float


class BackgroundReport(NamedTuple):
    """How the last mesh has used its background mesh."""

    asked: int
    outside: int
    farthest: float
    estimated_error: float
    tolerance: float


class LayersReport(NamedTuple):
    """One set of layers of the last mesh."""

    cells: int
    rows: int
    fewest_rows: int
    first_min: float
    first_mean: float
    first_max: float
    growth_min: float
    growth_mean: float
    growth_max: float


class AdaptationReport(NamedTuple):
    """The outcome of a loop."""

    iterations: int
    converged: int
    vertices: int
    triangles: int
    triangles_before: int
    error_max: float
    error_rms: float
    error_max_before: float
    error_rms_before: float
    size_min: float
    stretch_max: float
    outside: int
    best: int
    within: int
    tolerance: float
    estimated_error: float


class PartCounts(NamedTuple):
    """Numbers of a mesh in parts."""

    rank: int
    size: int
    own_vertices: int
    own_triangles: int
    all_vertices: int
    all_triangles: int
    all_edges: int
    crossings: int


class CellQuality(NamedTuple):
    """The quality of the elements. shape is sigma of the regular polygon over sigma = diameter / least inradius of two sides that meet (HDR sec. 1.1.1). scaled_jacobian is the least sine of an element's angles over the sine of the regular polygon's angle."""

    triangles3: int
    triangles6: int
    quads4: int
    quads8: int
    invalid: int
    shape_mean: float
    shape_min: float
    scaled_jacobian_mean: float
    scaled_jacobian_min: float
    least_jacobian_mean: float
    least_jacobian_min: float
    angle_min: float
    angle_max: float
    area: float
    triangle_share: float


class Face(NamedTuple):
    """The result of meshing a face."""

    ref: int
    status: int
    triangles: int
    why: str
    name: str
    rgb: int


class Quality(NamedTuple):
    """The shapes and sizes of the triangles."""

    vertices: int
    triangles: int
    edges: int
    open_edges: int
    q1_mean: float
    q1_min: float
    q1_p1: float
    q1_max: float
    q2_mean: float
    q2_min: float
    q2_p1: float
    q2_max: float
    angle_min: float
    angle_max: float
    area: float
    edge_min: float
    edge_mean: float
    edge_max: float
    degree6: float


class Delivered(NamedTuple):
    """Totals of a delivered mesh."""

    vertices: int
    edges: int
    triangles: int
    short_edges: int
    long_edges: int
    folded_triangles: int
    in_range: float
    not_met: int
    text: str
    surf0_calls: int
    surf1_calls: int
    surf2_calls: int
    size_calls: int
    seconds: float
    input_distance: float
    input_bound: float
    input_back_distance: float
    input_back_bound: float


class Measure(NamedTuple):
    """The spread of one measure."""

    name: str
    title: str
    entity: int
    classes: int
    values: int
    count: int  # type: ignore[assignment]
    mean: float
    min: float
    p1: float
    p99: float
    max: float
    limit: float
    beyond: int
    forced: int


class AtlasCounts(NamedTuple):
    """The numbers of the charts and other entities of an atlas."""

    vertices: int
    triangles: int
    charts: int
    triples: int
    mended: int


class AtlasChart(NamedTuple):
    """The plane of a chart: its place (x, y) lies at origin + x u + y v."""

    origin: tuple[float, float, float]
    u: tuple[float, float, float]
    v: tuple[float, float, float]
    normal: tuple[float, float, float]
    period: float
    vertices: int


class Geometry(NamedTuple):
    """A geometry, and the references that are its own: its face k is face first_face + k - 1 of the session."""

    kind: int
    faces: int
    first_face: int
    last_face: int
    first_curve: int
    last_curve: int
    first_point: int
    last_point: int


class MoleculeMeasures(NamedTuple):
    """Exact measures of the surface: no mesh is needed."""

    area: float
    volume: float
    atoms: int
    exposed_atoms: int
    shells: int
    cavities: int
    euler_number: int
    moved_radii: int
    convex_area: float
    torus_area: float
    concave_area: float


class TrianglesReport(NamedTuple):
    """Findings in the triangles of a session."""

    vertices: int
    triangles: int
    edges: int
    shells: int
    euler_number: int
    border_edges: int
    manifold_breaks: int
    one_sided_edges: int
    pinched_vertices: int
    turned_triangles: int
    repeated_triangles: int
    flat_triangles: int
    sharp_edges: int
    lines: int
    corners: int
    regions: int
    dropped_edges: int
    prolonged_edges: int
    faded_ends: int
    unfolded: int
    folded: int
    diagonal: float
    deviation: float
    sharp_angle: float


class RemeshSummary(NamedTuple):
    """The events of a remeshing."""

    vertices: int
    triangles: int
    boundary_edges: int
    bound_vertices: int
    free_vertices: int
    imposed_vertices: int
    removed_damaged: int
    removed_multiple: int
    removed_dangling: int
    removed_parts: int
    removed_overlapping: int
    parts_found: int
    parts_kept: int
    boundary: int
    area_given: float
    area_removed: float
    area_bound: float
    area_geometry: float
    area: float


class CadContent(NamedTuple):
    """The content of a file, counted."""

    faces: int
    edges: int
    vertices: int
    closed: int
    unit: str
    diagonal: float
    glue_tolerance: float
    open_tolerance: float
    losses: int
    bent_faces: int
    left_out: int
    references: int
    match_tolerance: float
    notes: str
    file_unit: str
    solids: int
    shared_faces: int
    small_features: int
    tree_rows: int


class CadSmallFeature(NamedTuple):
    """A feature below carreau_cad_options.min_feature."""

    kind: str
    size: float
    place: tuple[float, float, float]
    removed: int
    faces: str


class CadFace(NamedTuple):
    """The data of a face in the file."""

    number: int
    rgb: int
    name: str
    why: str
    solid: int
    solid_name: str
    other_solid: int
    reserved2: int
    other_solid_name: str
    layer: str


class CadTreeRow(NamedTuple):
    """A row of the tree of a file."""

    kind: str
    depth: int
    number: int
    rgb: int
    faces: int
    name: str
    layer: str


class CadContact(NamedTuple):
    """Two solids with faces that lie on each other."""

    solids: tuple[int, int]
    faces: tuple[int, int]
    pairs: int
    area: float
    place: tuple[float, float, float]


class CadFigures(NamedTuple):
    """Measures of a face."""

    kind: str
    area: float
    perimeter: float
    low: tuple[float, float, float]
    high: tuple[float, float, float]


class CadReport(NamedTuple):
    """The content of a file, and the number of potential meshing problems."""

    solids: int
    shells: int
    faces: int
    edges: int
    vertices: int
    seams: int
    poles: int
    closed_edges: int
    inner_wires: int
    internal_edges: int
    diagonal: float
    area: float
    volume: float
    shortest_edge: float
    largest_tolerance: float
    largest_gap: float
    kinds: int
    dangers: int


class CadDanger(NamedTuple):
    """A potential meshing problem."""

    kind: str
    face: int
    edge: int
    value: float
    cut: int
    sentence: str
    solids: tuple[int, int]


class CadGaps(NamedTuple):
    """Gaps between the curves of edges and their images on the faces beside, at ten places each."""

    largest: float
    edge: int
    face: int
    beyond: int


RECORDS: dict[type, Any] = {
    c.carreau_error_place: ErrorPlace,
    c.carreau_parameter: Parameter,
    c.carreau_report: Report,
    c.carreau_interface: Interface,
    c.carreau_background_report: BackgroundReport,
    c.carreau_layers_report: LayersReport,
    c.carreau_adaptation_report: AdaptationReport,
    c.carreau_part_counts: PartCounts,
    c.carreau_cell_quality: CellQuality,
    c.carreau_face: Face,
    c.carreau_quality: Quality,
    c.carreau_delivered: Delivered,
    c.carreau_measure: Measure,
    c.carreau_atlas_counts: AtlasCounts,
    c.carreau_atlas_chart: AtlasChart,
    c.carreau_geometry: Geometry,
    c.carreau_molecule_measures: MoleculeMeasures,
    c.carreau_triangles_report: TrianglesReport,
    c.carreau_remesh_summary: RemeshSummary,
    c.carreau_cad_content: CadContent,
    c.carreau_cad_small_feature: CadSmallFeature,
    c.carreau_cad_face: CadFace,
    c.carreau_cad_tree_row: CadTreeRow,
    c.carreau_cad_contact: CadContact,
    c.carreau_cad_figures: CadFigures,
    c.carreau_cad_report: CadReport,
    c.carreau_cad_danger: CadDanger,
    c.carreau_cad_gaps: CadGaps,
}

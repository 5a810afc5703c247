! SPDX-License-Identifier: BSD-3-Clause
!> The functions and structs of carreau_cad.h as Fortran sees them. Private to module carreau_cad.
!! Written by generate.py from carreau_cad.h: do not edit. After a change of the header:
!!   python3 cabi/fortran/generate.py cad_adapters/cad/include/carreau_cad.h cad_adapters/cad/fortran/carreau_cad_c.f90
module carreau_cad_c
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_null_funptr, c_null_ptr, &
    c_ptr, c_size_t
  implicit none
  public

  !> Options of reading a file.
  type, bind(c) :: c_cad_options
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: trap_faults = 0, loose_edges = 0
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: user = c_null_ptr
    integer(c_int32_t) :: imprint = 0, reserved = 0
    real(c_double) :: imprint_tolerance = 0
    type(c_ptr) :: unit = c_null_ptr
    real(c_double) :: scale = 0, min_feature = 0
  end type c_cad_options

  !> The content of a file, counted.
  type, bind(c) :: c_cad_content
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: faces = 0, edges = 0, vertices = 0, closed = 0
    type(c_ptr) :: unit = c_null_ptr
    real(c_double) :: diagonal = 0, glue_tolerance = 0, open_tolerance = 0
    integer(c_int32_t) :: losses = 0, bent_faces = 0, left_out = 0, references = 0
    real(c_double) :: match_tolerance = 0
    type(c_ptr) :: notes = c_null_ptr, file_unit = c_null_ptr
    integer(c_int32_t) :: solids = 0, shared_faces = 0, small_features = 0, tree_rows = 0
  end type c_cad_content

  !> A feature below carreau_cad_options.min_feature.
  type, bind(c) :: c_cad_small_feature
    integer(c_size_t) :: struct_size = 0
    type(c_ptr) :: kind = c_null_ptr
    real(c_double) :: size = 0, place(3) = 0
    integer(c_int32_t) :: removed = 0, reserved = 0
    type(c_ptr) :: faces = c_null_ptr
  end type c_cad_small_feature

  !> The data of a face in the file.
  type, bind(c) :: c_cad_face
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: number = 0, rgb = 0
    type(c_ptr) :: name = c_null_ptr, why = c_null_ptr
    integer(c_int32_t) :: solid = 0, reserved = 0
    type(c_ptr) :: solid_name = c_null_ptr
    integer(c_int32_t) :: other_solid = 0, reserved2 = 0
    type(c_ptr) :: other_solid_name = c_null_ptr, layer = c_null_ptr
  end type c_cad_face

  !> A row of the tree of a file.
  type, bind(c) :: c_cad_tree_row
    integer(c_size_t) :: struct_size = 0
    type(c_ptr) :: kind = c_null_ptr
    integer(c_int32_t) :: depth = 0, number = 0, rgb = 0, faces = 0
    type(c_ptr) :: name = c_null_ptr, layer = c_null_ptr
  end type c_cad_tree_row

  !> Two solids with faces that lie on each other.
  type, bind(c) :: c_cad_contact
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: solids(2) = 0, faces(2) = 0, pairs = 0, reserved = 0
    real(c_double) :: area = 0, place(3) = 0
  end type c_cad_contact

  !> Measures of a face.
  type, bind(c) :: c_cad_figures
    integer(c_size_t) :: struct_size = 0
    type(c_ptr) :: kind = c_null_ptr
    real(c_double) :: area = 0, perimeter = 0, low(3) = 0, high(3) = 0
  end type c_cad_figures

  !> The content of a file, and the number of potential meshing problems.
  type, bind(c) :: c_cad_report
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: solids = 0, shells = 0, faces = 0, edges = 0, vertices = 0, seams = 0, poles = 0, &
      closed_edges = 0, inner_wires = 0, internal_edges = 0
    real(c_double) :: diagonal = 0, area = 0, volume = 0, shortest_edge = 0, largest_tolerance = 0, largest_gap = 0
    integer(c_int32_t) :: kinds = 0, dangers = 0
  end type c_cad_report

  !> A potential meshing problem.
  type, bind(c) :: c_cad_danger
    integer(c_size_t) :: struct_size = 0
    type(c_ptr) :: kind = c_null_ptr
    integer(c_int32_t) :: face = 0, edge = 0
    real(c_double) :: value = 0
    integer(c_int32_t) :: cut = 0, reserved = 0
    type(c_ptr) :: sentence = c_null_ptr
    integer(c_int32_t) :: solids(2) = 0
  end type c_cad_danger

  !> Gaps between the curves of edges and their images on the faces beside, at ten places each.
  type, bind(c) :: c_cad_gaps
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: largest = 0
    integer(c_int32_t) :: edge = 0, face = 0, beyond = 0, reserved = 0
  end type c_cad_gaps

  interface
    !> Reads a file and adds all of its faces to a session.
    function c_cad_open(session, path, options, file) result(status) bind(c, name="carreau_cad_open")
      import :: c_cad_options, c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: path(*)
      type(c_cad_options), intent(in) :: options
      type(c_ptr), intent(inout) :: file
      integer(c_int32_t) :: status
    end function c_cad_open

    !> Does the same with the `size` bytes of a file in memory, which the call does not keep. format: "step", "iges" or
    !! "brep" (text or binary); NULL or "": found from the bytes.
    function c_cad_open_bytes(session, bytes, size, format, options, file) result(status) &
        bind(c, name="carreau_cad_open_bytes")
      import :: c_cad_options, c_char, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session, bytes
      integer(c_int64_t), value :: size
      character(kind=c_char), intent(in) :: format(*)
      type(c_cad_options), intent(in) :: options
      type(c_ptr), intent(inout) :: file
      integer(c_int32_t) :: status
    end function c_cad_open_bytes

    !> Creates an empty file: see carreau_cad_read.
    function c_cad_create(file) result(status) bind(c, name="carreau_cad_create")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), intent(inout) :: file
      integer(c_int32_t) :: status
    end function c_cad_create

    !> Frees a file, at any time: geometries of it stay in their sessions.
    subroutine c_cad_close(file) bind(c, name="carreau_cad_close")
      import :: c_ptr
      implicit none
      type(c_ptr), value :: file
    end subroutine c_cad_close

    !> Returns the sentence of the last call on the file, "" after success.
    function c_cad_last_error(file) result(error) bind(c, name="carreau_cad_last_error")
      import :: c_ptr
      implicit none
      type(c_ptr), value :: file
      type(c_ptr) :: error
    end function c_cad_last_error

    !> Reads STEP (.step, .stp), IGES (.iges, .igs) or BREP (.brep), by the suffix or else by the first bytes.
    function c_cad_read(file, path, options) result(status) bind(c, name="carreau_cad_read")
      import :: c_cad_options, c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      character(kind=c_char), intent(in) :: path(*)
      type(c_cad_options), intent(in) :: options
      integer(c_int32_t) :: status
    end function c_cad_read

    !> Reads the `size` bytes of a file in memory: see carreau_cad_open_bytes.
    function c_cad_read_bytes(file, bytes, size, format, options) result(status) bind(c, name="carreau_cad_read_bytes")
      import :: c_cad_options, c_char, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: file, bytes
      integer(c_int64_t), value :: size
      character(kind=c_char), intent(in) :: format(*)
      type(c_cad_options), intent(in) :: options
      integer(c_int32_t) :: status
    end function c_cad_read_bytes

    !> Makes parts that touch share faces and edges: see carreau_cad_options.imprint.
    function c_cad_imprint(file, tolerance, progress, user) result(status) bind(c, name="carreau_cad_imprint")
      import :: c_double, c_funptr, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      real(c_double), value :: tolerance
      type(c_funptr), value :: progress
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function c_cad_imprint

    !> Makes the body symmetric about the plane of a point and a normal (3 numbers each, any length but 0).
    function c_cad_mirror(file, point, normal) result(status) bind(c, name="carreau_cad_mirror")
      import :: c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      real(c_double), intent(in) :: point(*), normal(*)
      integer(c_int32_t) :: status
    end function c_cad_mirror

    !> Names the solids, and unnamed faces, of a file whose format has no names (BREP). n: the number of solids
    !! (carreau_cad_content.solids). names: n texts; NULL and "" name nothing. colours: n colours, 0xRRGGBB in sRGB, -1:
    !! none; NULL: all none.
    function c_cad_name_solids(file, n, names, colours) result(status) bind(c, name="carreau_cad_name_solids")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int64_t), value :: n
      type(c_ptr), value :: names
      integer(c_int32_t), intent(in) :: colours(*)
      integer(c_int32_t) :: status
    end function c_cad_name_solids

    !> Adds all faces to a session; a file may be added to several, and several times.
    function c_cad_add(file, session) result(status) bind(c, name="carreau_cad_add")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: file, session
      integer(c_int32_t) :: status
    end function c_cad_add

    !> Sets a size on the face of this number, or on all faces of this name, when hphy_flag = 2.
    function c_cad_set_face_size(file, face, size) result(status) bind(c, name="carreau_cad_set_face_size")
      import :: c_char, c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      character(kind=c_char), intent(in) :: face(*)
      real(c_double), value :: size
      integer(c_int32_t) :: status
    end function c_cad_set_face_size

    !> Sets a size on a vertex (dimension 0), an edge (1), a face (2) or all faces of a solid (3) by its number.
    function c_cad_set_size(file, dimension, number, size) result(status) bind(c, name="carreau_cad_set_size")
      import :: c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int32_t), value :: dimension, number
      real(c_double), value :: size
      integer(c_int32_t) :: status
    end function c_cad_set_size

    !> Counts the content of a file.
    function c_cad_info(file, content) result(status) bind(c, name="carreau_cad_info")
      import :: c_cad_content, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      type(c_cad_content), intent(inout) :: content
      integer(c_int32_t) :: status
    end function c_cad_info

    !> Gets a feature, by kind and then by its first face. index: from 0.
    function c_cad_small_feature_at(file, index, feature) result(status) bind(c, name="carreau_cad_small_feature_at")
      import :: c_cad_small_feature, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int64_t), value :: index
      type(c_cad_small_feature), intent(inout) :: feature
      integer(c_int32_t) :: status
    end function c_cad_small_feature_at

    !> Returns a sentence about an entity that could not be read. index: from 0.
    function c_cad_loss(file, index) result(loss) bind(c, name="carreau_cad_loss")
      import :: c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int64_t), value :: index
      type(c_ptr) :: loss
    end function c_cad_loss

    !> Gets the data of face `number`, from 1.
    function c_cad_file_face(file, number, face) result(status) bind(c, name="carreau_cad_file_face")
      import :: c_cad_face, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int32_t), value :: number
      type(c_cad_face), intent(inout) :: face
      integer(c_int32_t) :: status
    end function c_cad_file_face

    !> Returns the name of a vertex (dimension 0), an edge (1), a face (2) or a solid (3) by its number; "": it has
    !! none, or there is no such entity.
    function c_cad_entity_name(file, dimension, number) result(name) bind(c, name="carreau_cad_entity_name")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int32_t), value :: dimension, number
      type(c_ptr) :: name
    end function c_cad_entity_name

    !> Gets a row of the tree: assemblies, parts, solids, and faces, edges and vertices with a name, a colour or a layer
    !! of their own. index: from 0 to carreau_cad_content.tree_rows - 1.
    function c_cad_tree_at(file, index, row) result(status) bind(c, name="carreau_cad_tree_at")
      import :: c_cad_tree_row, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int64_t), value :: index
      type(c_cad_tree_row), intent(inout) :: row
      integer(c_int32_t) :: status
    end function c_cad_tree_at

    !> Finds solids that touch, by faces of both that lie on each other; faces between two solids are no contact.
    function c_cad_count_contacts(file, count) result(status) bind(c, name="carreau_cad_count_contacts")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function c_cad_count_contacts

    !> Gets a contact, by solids. index: from 0.
    function c_cad_contact_at(file, index, contact) result(status) bind(c, name="carreau_cad_contact_at")
      import :: c_cad_contact, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int64_t), value :: index
      type(c_cad_contact), intent(inout) :: contact
      integer(c_int32_t) :: status
    end function c_cad_contact_at

    !> Measures face `number`.
    function c_cad_measure_face(file, number, figures) result(status) bind(c, name="carreau_cad_measure_face")
      import :: c_cad_figures, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int32_t), value :: number
      type(c_cad_figures), intent(inout) :: figures
      integer(c_int32_t) :: status
    end function c_cad_measure_face

    !> Looks for potential meshing problems.
    function c_cad_inspect(file, tiny, report) result(status) bind(c, name="carreau_cad_inspect")
      import :: c_cad_report, c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      real(c_double), value :: tiny
      type(c_cad_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function c_cad_inspect

    !> Gets a kind of surfaces and the number of its faces, as found by carreau_cad_inspect; by name.
    function c_cad_surfaces(file, index, kind, count) result(status) bind(c, name="carreau_cad_surfaces")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int64_t), value :: index
      type(c_ptr), intent(inout) :: kind
      integer(c_int32_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function c_cad_surfaces

    !> Gets a danger that carreau_cad_inspect has found; by kind, worst first.
    function c_cad_danger_at(file, index, danger) result(status) bind(c, name="carreau_cad_danger_at")
      import :: c_cad_danger, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int64_t), value :: index
      type(c_cad_danger), intent(inout) :: danger
      integer(c_int32_t) :: status
    end function c_cad_danger_at

    !> Measures the gaps of all edges.
    function c_cad_measure_gaps(file, gaps) result(status) bind(c, name="carreau_cad_measure_gaps")
      import :: c_cad_gaps, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      type(c_cad_gaps), intent(inout) :: gaps
      integer(c_int32_t) :: status
    end function c_cad_measure_gaps

    !> Finds the point of a face, or of a part of a face, at (u, v) as callbacks get them. out_uv gets the parameters
    !! that its surface has there in the file; it may be NULL.
    function c_cad_point(file, face, u, v, xyz, uv) result(status) bind(c, name="carreau_cad_point")
      import :: c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int32_t), value :: face
      real(c_double), value :: u, v
      real(c_double), intent(inout) :: xyz(*), uv(*)
      integer(c_int32_t) :: status
    end function c_cad_point

    !> Finds (u, v), as callbacks get them, at a share from 0 to 1 of curve ic of a face; as carreau_cad_point.
    function c_cad_curve_point(file, face, ic, share, uv) result(status) bind(c, name="carreau_cad_curve_point")
      import :: c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int32_t), value :: face, ic
      real(c_double), value :: share
      real(c_double), intent(inout) :: uv(*)
      integer(c_int32_t) :: status
    end function c_cad_curve_point

    !> Counts the curves of a face and gives their edges, in order; with capacity 0 it counts only.
    function c_cad_curves(file, face, capacity, edges, count) result(status) bind(c, name="carreau_cad_curves")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int32_t), value :: face
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: edges(*)
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function c_cad_curves

    !> Counts the parts of a face of the file and gives their references, ascending; with capacity 0 it counts only.
    function c_cad_parts(file, face, capacity, refs, count) result(status) bind(c, name="carreau_cad_parts")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int32_t), value :: face
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: refs(*)
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function c_cad_parts

    !> Return the face (edge) of the file that a reference is, or is a part of; other numbers come back.
    function c_cad_whole_face(file, ref) result(face) bind(c, name="carreau_cad_whole_face")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int32_t), value :: ref
      integer(c_int32_t) :: face
    end function c_cad_whole_face

    function c_cad_whole_edge(file, ref) result(edge) bind(c, name="carreau_cad_whole_edge")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: file
      integer(c_int32_t), value :: ref
      integer(c_int32_t) :: edge
    end function c_cad_whole_edge
  end interface
end module carreau_cad_c

! SPDX-License-Identifier: BSD-3-Clause
!> Fortran 2003 face of carreau_cad.h: STEP, IGES and BREP files. The meaning of each routine and its errors are written there.
!! Different here: losses, dangers and kinds of surfaces count from 1; texts are copies; arguments that may be NULL are
!! optional.
module carreau_cad
  ! c_funptr: without it gfortran 12 cannot read its own module ("NULL appears on right-hand side").
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funloc, c_funptr, c_int32_t, c_int64_t, c_loc, c_null_char, &
    c_null_funptr, c_null_ptr, c_ptr
  use carreau, only: carreau_session, carreau_string, CARREAU_OK
  use carreau_cad_c
  implicit none
  private

  public :: carreau_cad_file, carreau_cad_content, carreau_cad_face, carreau_cad_figures, carreau_cad_report
  public :: carreau_cad_danger, carreau_cad_gaps, carreau_cad_progress_fn
  public :: carreau_cad_open, carreau_cad_create, carreau_cad_close, carreau_cad_last_error, carreau_cad_read
  public :: carreau_cad_small_feature, carreau_cad_small_feature_at, carreau_cad_entity_name
  public :: carreau_cad_tree_row, carreau_cad_tree_at, carreau_cad_contact, carreau_cad_count_contacts, carreau_cad_contact_at
  public :: carreau_cad_set_size, carreau_cad_open_bytes, carreau_cad_read_bytes, carreau_cad_imprint, carreau_cad_name_solids
  public :: carreau_cad_add, carreau_cad_set_face_size, carreau_cad_info, carreau_cad_loss, carreau_cad_file_face
  public :: carreau_cad_measure_face, carreau_cad_inspect, carreau_cad_surfaces, carreau_cad_danger_at
  public :: carreau_cad_measure_gaps, carreau_cad_point, carreau_cad_curve_point, carreau_cad_curves
  public :: carreau_cad_parts, carreau_cad_whole_face, carreau_cad_whole_edge, carreau_cad_mirror

  type :: carreau_cad_file
    type(c_ptr) :: handle = c_null_ptr
  end type carreau_cad_file

  type :: carreau_cad_content
    integer(c_int32_t) :: faces = 0, edges = 0, vertices = 0
    logical :: closed = .false.
    character(len=:), allocatable :: unit
    real(c_double) :: diagonal = 0, glue_tolerance = 0, open_tolerance = 0, match_tolerance = 0
    integer(c_int32_t) :: losses = 0, bent_faces = 0, left_out = 0, references = 0, solids = 0, shared_faces = 0, &
      small_features = 0, tree_rows = 0
    character(len=:), allocatable :: notes, file_unit
  end type carreau_cad_content

  type :: carreau_cad_face
    integer(c_int32_t) :: number = 0, rgb = 0, solid = 0, other_solid = 0
    character(len=:), allocatable :: name, why, solid_name, other_solid_name, layer
  end type carreau_cad_face

  type :: carreau_cad_tree_row
    character(len=:), allocatable :: kind, name, layer
    integer(c_int32_t) :: depth = 0, number = 0, rgb = 0, faces = 0
  end type carreau_cad_tree_row

  type :: carreau_cad_contact
    integer(c_int32_t), dimension(2) :: solids = 0, faces = 0
    integer(c_int32_t) :: pairs = 0
    real(c_double) :: area = 0
    real(c_double), dimension(3) :: place = 0
  end type carreau_cad_contact

  type :: carreau_cad_figures
    character(len=:), allocatable :: kind
    real(c_double) :: area = 0, perimeter = 0
    real(c_double), dimension(3) :: low = 0, high = 0
  end type carreau_cad_figures

  type :: carreau_cad_report
    integer(c_int32_t) :: solids = 0, shells = 0, faces = 0, edges = 0, vertices = 0, &
      seams = 0, poles = 0, closed_edges = 0, inner_wires = 0, internal_edges = 0
    real(c_double) :: diagonal = 0, area = 0, volume = 0, shortest_edge = 0, largest_tolerance = 0, largest_gap = 0
    integer(c_int32_t) :: kinds = 0, dangers = 0
  end type carreau_cad_report

  type :: carreau_cad_danger
    character(len=:), allocatable :: kind
    integer(c_int32_t) :: face = 0, edge = 0
    real(c_double) :: value = 0
    logical :: cut = .false.
    character(len=:), allocatable :: sentence
    integer(c_int32_t), dimension(2) :: solids = 0
  end type carreau_cad_danger

  type :: carreau_cad_small_feature
    character(len=:), allocatable :: kind, faces
    real(c_double) :: size = 0
    real(c_double), dimension(3) :: place = 0
    logical :: removed = .false.
  end type carreau_cad_small_feature

  type :: carreau_cad_gaps
    real(c_double) :: largest = 0
    integer(c_int32_t) :: edge = 0, face = 0, beyond = 0
  end type carreau_cad_gaps

  abstract interface
    !> A status other than 0 stops the reading.
    function carreau_cad_progress_fn(fraction, user) result(status) bind(c)
      import :: c_double, c_int32_t, c_ptr
      implicit none
      real(c_double), value :: fraction
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function carreau_cad_progress_fn
  end interface

contains

  ! ---- Files ----

  !> file: gets the file, which the caller closes by carreau_cad_close
  subroutine carreau_cad_open(session, path, status, file, trap_faults, progress, user, loose_edges, imprint, &
      imprint_tolerance, unit, scale, min_feature)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    type(carreau_cad_file), intent(inout), optional :: file
    logical, intent(in), optional :: trap_faults, loose_edges, imprint
    procedure(carreau_cad_progress_fn), optional :: progress
    type(c_ptr), intent(in), optional :: user
    real(c_double), intent(in), optional :: imprint_tolerance, scale, min_feature
    character(len=*), intent(in), optional :: unit
    type(c_ptr) :: opened
    character(kind=c_char), target :: sign(16)
    opened = c_null_ptr
    status = c_cad_open(session%handle, trim(path)//c_null_char, options_of(sign, trap_faults, progress, user, loose_edges, &
      imprint, imprint_tolerance, unit, scale, min_feature), opened)
    call hand_over(opened, status, file)
  end subroutine carreau_cad_open

  !> bytes: the file; format: 'step', 'iges', 'brep', or '' to find it from the bytes
  subroutine carreau_cad_open_bytes(session, bytes, format, status, file, trap_faults, progress, user, loose_edges, imprint, &
      imprint_tolerance, unit, scale, min_feature)
    type(carreau_session), intent(in) :: session
    character(kind=c_char), intent(in), target :: bytes(:)
    character(len=*), intent(in) :: format
    integer(c_int32_t), intent(out) :: status
    type(carreau_cad_file), intent(inout), optional :: file
    logical, intent(in), optional :: trap_faults, loose_edges, imprint
    procedure(carreau_cad_progress_fn), optional :: progress
    type(c_ptr), intent(in), optional :: user
    real(c_double), intent(in), optional :: imprint_tolerance, scale, min_feature
    character(len=*), intent(in), optional :: unit
    type(c_ptr) :: opened
    character(kind=c_char), target :: sign(16)
    character(kind=c_char), allocatable, target :: copy(:)
    allocate (copy(size(bytes)))
    copy = bytes
    opened = c_null_ptr
    status = c_cad_open_bytes(session%handle, address_of(copy), size(copy, kind=c_int64_t), trim(format)//c_null_char, &
      options_of(sign, trap_faults, progress, user, loose_edges, imprint, imprint_tolerance, unit, scale, min_feature), opened)
    call hand_over(opened, status, file)
  end subroutine carreau_cad_open_bytes

  subroutine hand_over(opened, status, file)
    type(c_ptr), intent(in) :: opened
    integer(c_int32_t), intent(in) :: status
    type(carreau_cad_file), intent(inout), optional :: file
    if (present(file) .and. status == CARREAU_OK) then
      file%handle = opened
    else
      call c_cad_close(opened)
    end if
  end subroutine hand_over

  !> The address of the first byte, or of a dummy for an empty array, which has none.
  function address_of(bytes) result(address)
    character(kind=c_char), intent(in), target :: bytes(:)
    type(c_ptr) :: address
    character(kind=c_char), save, target :: nothing = c_null_char
    address = c_loc(nothing)
    if (size(bytes) > 0) address = c_loc(bytes(1))
  end function address_of

  !> sign: room for the unit, which lives as long as the options
  function options_of(sign, trap_faults, progress, user, loose_edges, imprint, imprint_tolerance, unit, scale, &
      min_feature) result(options)
    character(kind=c_char), intent(inout), target :: sign(16)
    logical, intent(in), optional :: trap_faults
    procedure(carreau_cad_progress_fn), optional :: progress
    type(c_ptr), intent(in), optional :: user
    logical, intent(in), optional :: loose_edges, imprint
    real(c_double), intent(in), optional :: imprint_tolerance, scale, min_feature
    character(len=*), intent(in), optional :: unit
    type(c_cad_options) :: options
    integer :: i
    options%struct_size = size(transfer(options, [c_null_char]))
    if (present(trap_faults)) options%trap_faults = merge(1_c_int32_t, 0_c_int32_t, trap_faults)
    if (present(loose_edges)) options%loose_edges = merge(1_c_int32_t, 0_c_int32_t, loose_edges)
    if (present(progress)) options%progress = c_funloc(progress)
    if (present(user)) options%user = user
    if (present(imprint)) options%imprint = merge(1_c_int32_t, 0_c_int32_t, imprint)
    if (present(imprint_tolerance)) options%imprint_tolerance = imprint_tolerance
    if (present(scale)) options%scale = scale
    if (present(min_feature)) options%min_feature = min_feature
    if (.not. present(unit)) return
    sign = c_null_char
    do i = 1, min(len_trim(unit), 15)
      sign(i) = unit(i:i)
    end do
    options%unit = c_loc(sign)
  end function options_of

  subroutine carreau_cad_create(file, status)
    type(carreau_cad_file), intent(inout) :: file
    integer(c_int32_t), intent(out) :: status
    status = c_cad_create(file%handle)
  end subroutine carreau_cad_create

  subroutine carreau_cad_close(file)
    type(carreau_cad_file), intent(inout) :: file
    call c_cad_close(file%handle)
    file%handle = c_null_ptr
  end subroutine carreau_cad_close

  function carreau_cad_last_error(file) result(sentence)
    type(carreau_cad_file), intent(in) :: file
    character(len=:), allocatable :: sentence
    sentence = carreau_string(c_cad_last_error(file%handle))
  end function carreau_cad_last_error

  subroutine carreau_cad_read(file, path, status, trap_faults, progress, user, loose_edges, imprint, imprint_tolerance, &
      unit, scale, min_feature)
    type(carreau_cad_file), intent(in) :: file
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    logical, intent(in), optional :: trap_faults, loose_edges, imprint
    procedure(carreau_cad_progress_fn), optional :: progress
    type(c_ptr), intent(in), optional :: user
    real(c_double), intent(in), optional :: imprint_tolerance, scale, min_feature
    character(len=*), intent(in), optional :: unit
    character(kind=c_char), target :: sign(16)
    status = c_cad_read(file%handle, trim(path)//c_null_char, options_of(sign, trap_faults, progress, user, loose_edges, &
      imprint, imprint_tolerance, unit, scale, min_feature))
  end subroutine carreau_cad_read

  !> bytes: the file; format: 'step', 'iges', 'brep', or '' to find it from the bytes
  subroutine carreau_cad_read_bytes(file, bytes, format, status, trap_faults, progress, user, loose_edges, imprint, &
      imprint_tolerance, unit, scale, min_feature)
    type(carreau_cad_file), intent(in) :: file
    character(kind=c_char), intent(in), target :: bytes(:)
    character(len=*), intent(in) :: format
    integer(c_int32_t), intent(out) :: status
    logical, intent(in), optional :: trap_faults, loose_edges, imprint
    procedure(carreau_cad_progress_fn), optional :: progress
    type(c_ptr), intent(in), optional :: user
    real(c_double), intent(in), optional :: imprint_tolerance, scale, min_feature
    character(len=*), intent(in), optional :: unit
    character(kind=c_char), target :: sign(16)
    character(kind=c_char), allocatable, target :: copy(:)
    allocate (copy(size(bytes)))
    copy = bytes
    status = c_cad_read_bytes(file%handle, address_of(copy), size(copy, kind=c_int64_t), trim(format)//c_null_char, &
      options_of(sign, trap_faults, progress, user, loose_edges, imprint, imprint_tolerance, unit, scale, min_feature))
  end subroutine carreau_cad_read_bytes

  !> tolerance: distance up to which parts touch; 0: the tolerances of the file
  subroutine carreau_cad_imprint(file, tolerance, status, progress, user)
    type(carreau_cad_file), intent(in) :: file
    real(c_double), intent(in) :: tolerance
    integer(c_int32_t), intent(out) :: status
    procedure(carreau_cad_progress_fn), optional :: progress
    type(c_ptr), intent(in), optional :: user
    type(c_funptr) :: listener
    type(c_ptr) :: handed
    listener = c_null_funptr
    handed = c_null_ptr
    if (present(progress)) listener = c_funloc(progress)
    if (present(user)) handed = user
    status = c_cad_imprint(file%handle, tolerance, listener, handed)
  end subroutine carreau_cad_imprint

  !> Cuts faces across the plane, or adds the other half of a body on one side of it.
  subroutine carreau_cad_mirror(file, point, normal, status)
    type(carreau_cad_file), intent(in) :: file
    real(c_double), intent(in) :: point(3), normal(3)
    integer(c_int32_t), intent(out) :: status
    status = c_cad_mirror(file%handle, point, normal)
  end subroutine carreau_cad_mirror

  !> names: of each solid; colours: of each, 0xRRGGBB, -1: none
  subroutine carreau_cad_name_solids(file, names, status, colours)
    type(carreau_cad_file), intent(in) :: file
    character(len=*), intent(in) :: names(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t), intent(in), optional :: colours(:)
    character(kind=c_char), allocatable, target :: texts(:, :)
    type(c_ptr), allocatable, target :: addresses(:)
    integer(c_int32_t), allocatable :: rgb(:)
    integer :: i, k
    allocate (texts(len(names) + 1, size(names)), addresses(size(names)), rgb(size(names)))
    texts = c_null_char
    rgb = -1
    if (present(colours)) rgb(:min(size(rgb), size(colours))) = colours(:min(size(rgb), size(colours)))
    do k = 1, size(names)
      do i = 1, len_trim(names(k))
        texts(i, k) = names(k)(i:i)
      end do
      addresses(k) = c_loc(texts(1, k))
    end do
    status = c_cad_name_solids(file%handle, size(names, kind=c_int64_t), c_loc(addresses), rgb)
  end subroutine carreau_cad_name_solids

  subroutine carreau_cad_add(file, session, status)
    type(carreau_cad_file), intent(in) :: file
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(out) :: status
    status = c_cad_add(file%handle, session%handle)
  end subroutine carreau_cad_add

  subroutine carreau_cad_set_face_size(file, face, size, status)
    type(carreau_cad_file), intent(in) :: file
    character(len=*), intent(in) :: face
    real(c_double), intent(in) :: size
    integer(c_int32_t), intent(out) :: status
    status = c_cad_set_face_size(file%handle, trim(face)//c_null_char, size)
  end subroutine carreau_cad_set_face_size

  !> dimension: 0 a vertex, 1 an edge, 2 a face, 3 all faces of a solid
  subroutine carreau_cad_set_size(file, dimension, number, size, status)
    type(carreau_cad_file), intent(in) :: file
    integer(c_int32_t), intent(in) :: dimension, number
    real(c_double), intent(in) :: size
    integer(c_int32_t), intent(out) :: status
    status = c_cad_set_size(file%handle, dimension, number, size)
  end subroutine carreau_cad_set_size

  ! ---- Content of a file ----

  subroutine carreau_cad_info(file, content, status)
    type(carreau_cad_file), intent(in) :: file
    type(carreau_cad_content), intent(out) :: content
    integer(c_int32_t), intent(out) :: status
    type(c_cad_content) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_cad_info(file%handle, c)
    if (status /= CARREAU_OK) return
    content%faces = c%faces
    content%edges = c%edges
    content%vertices = c%vertices
    content%closed = c%closed /= 0
    content%unit = carreau_string(c%unit)
    content%diagonal = c%diagonal
    content%glue_tolerance = c%glue_tolerance
    content%open_tolerance = c%open_tolerance
    content%losses = c%losses
    content%bent_faces = c%bent_faces
    content%left_out = c%left_out
    content%references = c%references
    content%match_tolerance = c%match_tolerance
    content%notes = carreau_string(c%notes)
    content%file_unit = carreau_string(c%file_unit)
    content%solids = c%solids
    content%shared_faces = c%shared_faces
    content%small_features = c%small_features
    content%tree_rows = c%tree_rows
  end subroutine carreau_cad_info

  !> index: from 1
  subroutine carreau_cad_small_feature_at(file, index, feature, status)
    type(carreau_cad_file), intent(in) :: file
    integer(c_int64_t), intent(in) :: index
    type(carreau_cad_small_feature), intent(out) :: feature
    integer(c_int32_t), intent(out) :: status
    type(c_cad_small_feature) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_cad_small_feature_at(file%handle, index - 1, c)
    if (status /= CARREAU_OK) return
    feature%kind = carreau_string(c%kind)
    feature%faces = carreau_string(c%faces)
    feature%size = c%size
    feature%place = c%place
    feature%removed = c%removed /= 0
  end subroutine carreau_cad_small_feature_at

  !> dimension: 0 to 3; '': it has none, or there is no such entity
  function carreau_cad_entity_name(file, dimension, number) result(name)
    type(carreau_cad_file), intent(in) :: file
    integer(c_int32_t), intent(in) :: dimension, number
    character(len=:), allocatable :: name
    name = carreau_string(c_cad_entity_name(file%handle, dimension, number))
  end function carreau_cad_entity_name

  !> index: from 1
  subroutine carreau_cad_tree_at(file, index, row, status)
    type(carreau_cad_file), intent(in) :: file
    integer(c_int64_t), intent(in) :: index
    type(carreau_cad_tree_row), intent(out) :: row
    integer(c_int32_t), intent(out) :: status
    type(c_cad_tree_row) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_cad_tree_at(file%handle, index - 1, c)
    if (status /= CARREAU_OK) return
    row%kind = carreau_string(c%kind)
    row%name = carreau_string(c%name)
    row%layer = carreau_string(c%layer)
    row%depth = c%depth
    row%number = c%number
    row%rgb = c%rgb
    row%faces = c%faces
  end subroutine carreau_cad_tree_at

  subroutine carreau_cad_count_contacts(file, count, status)
    type(carreau_cad_file), intent(in) :: file
    integer(c_int64_t), intent(out) :: count
    integer(c_int32_t), intent(out) :: status
    status = c_cad_count_contacts(file%handle, count)
  end subroutine carreau_cad_count_contacts

  !> index: from 1
  subroutine carreau_cad_contact_at(file, index, contact, status)
    type(carreau_cad_file), intent(in) :: file
    integer(c_int64_t), intent(in) :: index
    type(carreau_cad_contact), intent(out) :: contact
    integer(c_int32_t), intent(out) :: status
    type(c_cad_contact) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_cad_contact_at(file%handle, index - 1, c)
    if (status /= CARREAU_OK) return
    contact%solids = c%solids
    contact%faces = c%faces
    contact%pairs = c%pairs
    contact%area = c%area
    contact%place = c%place
  end subroutine carreau_cad_contact_at

  !> index: from 1; "" when there is no such
  function carreau_cad_loss(file, index) result(sentence)
    type(carreau_cad_file), intent(in) :: file
    integer(c_int64_t), intent(in) :: index
    character(len=:), allocatable :: sentence
    sentence = carreau_string(c_cad_loss(file%handle, index - 1))
  end function carreau_cad_loss

  subroutine carreau_cad_file_face(file, number, face, status)
    type(carreau_cad_file), intent(in) :: file
    integer(c_int32_t), intent(in) :: number
    type(carreau_cad_face), intent(out) :: face
    integer(c_int32_t), intent(out) :: status
    type(c_cad_face) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_cad_file_face(file%handle, number, c)
    if (status /= CARREAU_OK) return
    face%number = c%number
    face%rgb = c%rgb
    face%name = carreau_string(c%name)
    face%why = carreau_string(c%why)
    face%solid = c%solid
    face%solid_name = carreau_string(c%solid_name)
    face%other_solid = c%other_solid
    face%other_solid_name = carreau_string(c%other_solid_name)
    face%layer = carreau_string(c%layer)
  end subroutine carreau_cad_file_face

  subroutine carreau_cad_measure_face(file, number, figures, status)
    type(carreau_cad_file), intent(in) :: file
    integer(c_int32_t), intent(in) :: number
    type(carreau_cad_figures), intent(out) :: figures
    integer(c_int32_t), intent(out) :: status
    type(c_cad_figures) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_cad_measure_face(file%handle, number, c)
    if (status /= CARREAU_OK) return
    figures%kind = carreau_string(c%kind)
    figures%area = c%area
    figures%perimeter = c%perimeter
    figures%low = c%low
    figures%high = c%high
  end subroutine carreau_cad_measure_face

  ! ---- Potential meshing problems ----

  !> tiny: a share of the diagonal; 1e-3 unless given
  subroutine carreau_cad_inspect(file, report, status, tiny)
    type(carreau_cad_file), intent(in) :: file
    type(carreau_cad_report), intent(out) :: report
    integer(c_int32_t), intent(out) :: status
    real(c_double), intent(in), optional :: tiny
    type(c_cad_report) :: c
    real(c_double) :: share
    share = 0
    if (present(tiny)) share = tiny
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_cad_inspect(file%handle, share, c)
    if (status /= CARREAU_OK) return
    report = carreau_cad_report(c%solids, c%shells, c%faces, c%edges, c%vertices, c%seams, c%poles, c%closed_edges, &
      c%inner_wires, c%internal_edges, c%diagonal, c%area, c%volume, c%shortest_edge, c%largest_tolerance, &
      c%largest_gap, c%kinds, c%dangers)
  end subroutine carreau_cad_inspect

  !> index: from 1
  subroutine carreau_cad_surfaces(file, index, kind, count, status)
    type(carreau_cad_file), intent(in) :: file
    integer(c_int64_t), intent(in) :: index
    character(len=:), allocatable, intent(out) :: kind
    integer(c_int32_t), intent(out) :: count, status
    type(c_ptr) :: text
    text = c_null_ptr
    count = 0
    status = c_cad_surfaces(file%handle, index - 1, text, count)
    kind = carreau_string(text)
  end subroutine carreau_cad_surfaces

  !> index: from 1
  subroutine carreau_cad_danger_at(file, index, danger, status)
    type(carreau_cad_file), intent(in) :: file
    integer(c_int64_t), intent(in) :: index
    type(carreau_cad_danger), intent(out) :: danger
    integer(c_int32_t), intent(out) :: status
    type(c_cad_danger) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_cad_danger_at(file%handle, index - 1, c)
    if (status /= CARREAU_OK) return
    danger%kind = carreau_string(c%kind)
    danger%face = c%face
    danger%edge = c%edge
    danger%value = c%value
    danger%cut = c%cut /= 0
    danger%sentence = carreau_string(c%sentence)
    danger%solids = c%solids
  end subroutine carreau_cad_danger_at

  subroutine carreau_cad_measure_gaps(file, gaps, status)
    type(carreau_cad_file), intent(in) :: file
    type(carreau_cad_gaps), intent(out) :: gaps
    integer(c_int32_t), intent(out) :: status
    type(c_cad_gaps) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_cad_measure_gaps(file%handle, c)
    if (status == CARREAU_OK) gaps = carreau_cad_gaps(c%largest, c%edge, c%face, c%beyond)
  end subroutine carreau_cad_measure_gaps

  ! ---- Places, references ----

  !> file_uv: the parameters that the surface has in the file
  subroutine carreau_cad_point(file, face, u, v, xyz, status, file_uv)
    type(carreau_cad_file), intent(in) :: file
    integer(c_int32_t), intent(in) :: face
    real(c_double), intent(in) :: u, v
    real(c_double), intent(inout) :: xyz(3)
    integer(c_int32_t), intent(out) :: status
    real(c_double), intent(out), optional :: file_uv(2)
    real(c_double) :: uv(2)
    uv = 0
    status = c_cad_point(file%handle, face, u, v, xyz, uv)
    if (present(file_uv)) file_uv = uv
  end subroutine carreau_cad_point

  subroutine carreau_cad_curve_point(file, face, ic, share, uv, status)
    type(carreau_cad_file), intent(in) :: file
    integer(c_int32_t), intent(in) :: face, ic
    real(c_double), intent(in) :: share
    real(c_double), intent(inout) :: uv(2)
    integer(c_int32_t), intent(out) :: status
    status = c_cad_curve_point(file%handle, face, ic, share, uv)
  end subroutine carreau_cad_curve_point

  subroutine carreau_cad_curves(file, face, edges, status)
    type(carreau_cad_file), intent(in) :: file
    integer(c_int32_t), intent(in) :: face
    integer(c_int32_t), allocatable, intent(out) :: edges(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: n
    integer(c_int32_t) :: none(1)
    n = 0
    status = c_cad_curves(file%handle, face, 0_c_int64_t, none, n)
    if (status /= CARREAU_OK) return
    allocate (edges(n))
    status = c_cad_curves(file%handle, face, n, edges, n)
  end subroutine carreau_cad_curves

  subroutine carreau_cad_parts(file, face, refs, status)
    type(carreau_cad_file), intent(in) :: file
    integer(c_int32_t), intent(in) :: face
    integer(c_int32_t), allocatable, intent(out) :: refs(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: n
    integer(c_int32_t) :: none(1)
    n = 0
    status = c_cad_parts(file%handle, face, 0_c_int64_t, none, n)
    if (status /= CARREAU_OK) return
    allocate (refs(n))
    status = c_cad_parts(file%handle, face, n, refs, n)
  end subroutine carreau_cad_parts

  function carreau_cad_whole_face(file, ref) result(whole)
    type(carreau_cad_file), intent(in) :: file
    integer(c_int32_t), intent(in) :: ref
    integer(c_int32_t) :: whole
    whole = c_cad_whole_face(file%handle, ref)
  end function carreau_cad_whole_face

  function carreau_cad_whole_edge(file, ref) result(whole)
    type(carreau_cad_file), intent(in) :: file
    integer(c_int32_t), intent(in) :: ref
    integer(c_int32_t) :: whole
    whole = c_cad_whole_edge(file%handle, ref)
  end function carreau_cad_whole_edge

end module carreau_cad

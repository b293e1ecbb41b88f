(** What the kernel answers, written by `ROCQ_UPDATE=always cargo test -p tautline-proofs --test all rocq`. Do not edit. *)
From Coq Require Import ZArith NArith List.
Import ListNotations.

From Coq Require Import ZArith NArith List.
From Tautline Require Import Certificate.
Import ListNotations.
Local Open Scope Z_scope.

Definition rule_ : rule := {|
 robots := 2; colours := 1; reach := 0; far := true; width := 2;
 moves :=
 [[((1, 0), [(true, 0%nat)]);
  ((0, 1), [(true, 0%nat)]);
  ((-1, 0), [(true, 0%nat)]);
  ((0, -1), [(true, 0%nat)]);
  ((0, 0), [(true, 0%nat)])]];
 admitted :=
 Node [Node [Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x1fdffff%N];
 Node [Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x1ffdfff%N];
 Node [Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x1ffff7f%N];
 Node [Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x0%N;
 Leaf 0x1fff7ff%N];
 Node [Leaf 0x1ffff7f%N;
 Leaf 0x1fff7ff%N;
 Leaf 0x1fdffff%N;
 Leaf 0x1ffdfff%N;
 Leaf 0x1ffffff%N]];
 promised :=
 Leaf 0x0%N;
 started :=
 Node [Node [Leaf 0x1ffefff%N]] |}.

Definition certificate_ : certificate := {| window := 0; kept :=
 Leaf 0x0%N |}.

Theorem accepted : accepts rule_ certificate_ = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Theorem holds_ : holds rule_.
Proof. exact (sound rule_ certificate_ accepted). Qed.
